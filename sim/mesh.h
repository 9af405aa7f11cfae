#pragma once
// Plain meshes, shared by the physics and by what reads and writes files.
#include <Eigen/Core>
#include <array>
#include <vector>

namespace softreel::sim {

using Vec3 = Eigen::Vector3d;
using Triangle = std::array<int, 3>;  ///< vertex indices, counter-clockwise seen from outside
using Tet = std::array<int, 4>;       ///< vertex indices, positive volume: (b-a) x (c-a) . (d-a) > 0

/// Triangle surface with welded vertices.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<Triangle> triangles;
};

/// Tetrahedral volume mesh.
struct TetMesh {
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<Tet> tets;
};

/// Signed volume [m^3] of a tetrahedron; positive for the orientation of `Tet`.
double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Faces that belong to exactly one tetrahedron, oriented outwards, in the order of the tets. O(n log n).
std::vector<Triangle> boundary_triangles(const TetMesh& mesh);

}  // namespace softreel::sim
