#pragma once
// From a field to a closed triangle mesh with well-shaped triangles.
#include "assets/generate/shape.h"
#include "sim/mesh.h"

namespace softreel::generate {

/// Marching tetrahedra (Doi and Koide, 1991) on cubes cut into six (Kuhn): closed and manifold whatever the field.
/// `low`, `high`: a box around the surface [m]; `cell` [m].
sim::TriangleMesh polygonize(const Field& field, const Vec3& low, const Vec3& high, double cell);

/// Isotropic remeshing (Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", SGP 2004): splits,
/// collapses, flips, relaxation, each time back onto the field. `edge_length` gives the wanted length at a point [m].
void remesh(sim::TriangleMesh& mesh, const Field& field, const Field& edge_length, int rounds);

}  // namespace softreel::generate
