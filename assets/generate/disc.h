#pragma once
// A flat disc, for drumheads.
#include "sim/mesh.h"

namespace softreel::generate {

/// In the xz plane around the origin, normal +y: ring r has 6 r vertices, so that all triangles are nearly alike.
/// 1 + 3 rings (rings + 1) vertices; `radius` [m].
sim::TriangleMesh disc(double radius, int rings);

}  // namespace softreel::generate
