#include "sim/springs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/mesh_topology.h"
#include "sim/spring_stencil.h"

namespace softreel::sim {
namespace {

struct SpringKernel {
  static constexpr int kCorners = 2;
  static constexpr bool kConstantHessian = false;
  std::vector<Spring> springs;

  double energy(int e, const Corners<2>& X) const {
    const Spring& s = springs[static_cast<size_t>(e)];
    const double stretch = (X.col(0) - X.col(1)).norm() - s.length;
    return 0.5 * s.stiffness * stretch * stretch;
  }

  void gradient(int e, const Corners<2>& X, Corners<2>& out) const {
    const Spring& s = springs[static_cast<size_t>(e)];
    const Eigen::Vector3d d = X.col(0) - X.col(1);
    const double length = d.norm();
    out.col(0) = length > 0 ? Eigen::Vector3d(s.stiffness * (length - s.length) / length * d) : Eigen::Vector3d::Zero();
    out.col(1) = -out.col(0);
  }

  void hessian(int e, const Corners<2>& X, Definiteness definiteness, ElementHessian<2>& out) const {
    const Spring& s = springs[static_cast<size_t>(e)];
    const Eigen::Vector3d d = X.col(0) - X.col(1);
    const double length = d.norm();
    if (!(length > 0)) return spring_block(s.stiffness * Eigen::Matrix3d::Identity(), out);
    const Eigen::Vector3d n = d / length;
    double across = 1 - s.length / length;  // negative under compression
    if (definiteness == Definiteness::kClamped) across = std::max(across, 0.0);
    const Eigen::Matrix3d along = n * n.transpose();
    spring_block(s.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along)), out);
  }
};

Spring between(const TriangleMesh& mesh, int a, int b, double stiffness) {
  return {a, b, stiffness, (mesh.vertices[static_cast<size_t>(a)] - mesh.vertices[static_cast<size_t>(b)]).norm()};
}

void add_bending(const TriangleMesh& mesh, double stiffness, std::vector<Spring>& springs) {
  if (stiffness <= 0) return;
  for (const Hinge& h : hinges(mesh)) springs.push_back(between(mesh, h.opposite_left, h.opposite_right, stiffness));
}

}  // namespace

std::unique_ptr<EnergyTerm> make_springs(const std::vector<Spring>& springs) {
  return std::make_unique<ElementTerm<SpringKernel>>("springs", EnergyKind::kElastic, spring_stencils(springs),
                                                     SpringKernel{springs});
}

std::vector<Spring> grid_springs(const TriangleMesh& sheet, int cells_x, int cells_z, const SpringStiffness& k) {
  std::vector<Spring> springs;
  const auto at = [&](int i, int j) { return j * (cells_x + 1) + i; };
  const auto connect = [&](int i, int j, int di, int dj, double stiffness) {
    const int i2 = i + di, j2 = j + dj;
    if (stiffness > 0 && i2 >= 0 && i2 <= cells_x && j2 <= cells_z)
      springs.push_back(between(sheet, at(i, j), at(i2, j2), stiffness));
  };
  for (int j = 0; j <= cells_z; ++j) {
    for (int i = 0; i <= cells_x; ++i) {
      connect(i, j, 1, 0, k.structural);
      connect(i, j, 0, 1, k.structural);
      connect(i, j, 1, 1, k.shear);
      connect(i, j, -1, 1, k.shear);
      connect(i, j, 2, 0, k.bend);
      connect(i, j, 0, 2, k.bend);
    }
  }
  return springs;
}

std::vector<Spring> mesh_springs(const TriangleMesh& mesh, const SpringStiffness& k) {
  std::vector<Spring> springs;
  if (k.structural > 0)
    for (const auto& [a, b] : edges(mesh)) springs.push_back(between(mesh, a, b, k.structural));
  add_bending(mesh, k.bend, springs);
  return springs;
}

std::vector<Spring> young_springs(const TriangleMesh& mesh, double young, double thickness, double bend) {
  std::map<std::pair<int, int>, double> area;  // of the triangles at each edge
  for (const Triangle& t : mesh.triangles) {
    const Vec3& origin = mesh.vertices[static_cast<size_t>(t[0])];
    const Vec3 e1 = mesh.vertices[static_cast<size_t>(t[1])] - origin;
    const Vec3 e2 = mesh.vertices[static_cast<size_t>(t[2])] - origin;
    for (size_t a = 0; a < 3; ++a) {
      const int p = t[a], q = t[(a + 1) % 3];
      area[{std::min(p, q), std::max(p, q)}] += 0.5 * e1.cross(e2).norm();
    }
  }
  std::vector<Spring> springs;
  for (const auto& [edge, sum] : area) {
    Spring s = between(mesh, edge.first, edge.second, 0);
    if (s.length > 0) s.stiffness = young * thickness * sum / (s.length * s.length);
    springs.push_back(s);
  }
  add_bending(mesh, bend, springs);
  return springs;
}

}  // namespace softreel::sim
