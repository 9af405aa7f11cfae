#pragma once
// Mass-spring cloth: springs along edges (structural), across cells (shear) and over two triangles (bend).
#include <memory>
#include <vector>

#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

struct Spring {
  int a = 0, b = 0;      ///< vertex indices
  double stiffness = 0;  ///< [N/m] >= 0
  double length = 0;     ///< rest length [m] >= 0
};

/// Stiffnesses of the three kinds of springs [N/m]; 0 leaves the kind out.
struct SpringStiffness {
  double structural = 0;
  double shear = 0;
  double bend = 0;
};

/// E = sum k/2 (|d| - L)^2. Its Hessian is indefinite under compression and clamped per spring; at zero length,
/// where the direction is undefined, force and geometric part are zero.
std::unique_ptr<EnergyTerm> make_springs(const std::vector<Spring>& springs);

/// Springs of a regular grid of (cells_x + 1) x (cells_z + 1) vertices (grid_sheet): neighbours, diagonals, every
/// second neighbour.
std::vector<Spring> grid_springs(const TriangleMesh& sheet, int cells_x, int cells_z, const SpringStiffness&);

/// Springs of any triangle mesh: edges as structural springs, the opposite vertices of the two triangles at an edge
/// as bending springs. There are no shear springs: triangles do not shear without stretching an edge.
std::vector<Spring> mesh_springs(const TriangleMesh& mesh, const SpringStiffness&);

/// Structural stiffness per edge from Young's modulus [Pa] and thickness [m], k = E t (sum of adjacent areas)/L^2 (van
/// Gelder 1998). Exact only on some meshes; with both diagonals of a grid 1.2 times too stiff.
std::vector<Spring> young_springs(const TriangleMesh& mesh, double young, double thickness, double bend);

}  // namespace softreel::sim
