#pragma once
// Regular rest shapes: sheets of cloth and blocks of tetrahedra.
#include "sim/mesh.h"

namespace softreel::sim {

/// Flat sheet in the xz plane, centred on the origin, normal +y; (cells_x + 1)(cells_z + 1) vertices, x fastest;
/// the diagonals of the cells alternate so that the sheet bends alike both ways. Sizes in [m], cells >= 1.
TriangleMesh grid_sheet(double size_x, double size_z, int cells_x, int cells_z);

/// Box centred on the origin, cells of six tetrahedra around a common diagonal (Kuhn 1960); size [m], cells >= 1.
TetMesh block_of_tets(const Vec3& size, int cells_x, int cells_y, int cells_z);

}  // namespace softreel::sim
