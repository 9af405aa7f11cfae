#include "assets/tet_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace softreel::assets {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double triangle_area(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) {
  return (b - a).cross(c - a).norm() / 2;
}

/// 3 r_in / r_circ with r_in = 3 V / (sum of areas) and r_circ from the products of opposite edges (Cayley).
double radius_ratio(const std::array<sim::Vec3, 4>& p, double volume) {
  const double areas = triangle_area(p[1], p[2], p[3]) + triangle_area(p[0], p[2], p[3]) +
                       triangle_area(p[0], p[1], p[3]) + triangle_area(p[0], p[1], p[2]);
  const double a = (p[1] - p[0]).norm() * (p[3] - p[2]).norm();
  const double b = (p[2] - p[0]).norm() * (p[3] - p[1]).norm();
  const double c = (p[3] - p[0]).norm() * (p[2] - p[1]).norm();
  const double product = std::sqrt(std::max(0.0, (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a)));
  if (!(product > 0) || !(areas > 0)) return 0;
  const double circumradius = product / (24 * std::abs(volume));
  return 3 * (3 * std::abs(volume) / areas) / circumradius;
}

/// Angle at edge i j between the faces that hold k and l [deg].
double dihedral(const sim::Vec3& i, const sim::Vec3& j, const sim::Vec3& k, const sim::Vec3& l) {
  const sim::Vec3 axis = (j - i).normalized();
  const sim::Vec3 u = (k - i) - axis * axis.dot(k - i), v = (l - i) - axis * axis.dot(l - i);
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

}  // namespace

double radius_ratio(const sim::TetMesh& mesh, const sim::Tet& tet) {
  std::array<sim::Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.vertices[static_cast<std::size_t>(tet[k])];
  return radius_ratio(p, sim::tet_volume(p[0], p[1], p[2], p[3]));
}

TetQuality tet_quality(const sim::TetMesh& mesh) {
  if (mesh.tets.empty()) throw std::logic_error("tet_quality of an empty mesh");
  constexpr int kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  std::vector<double> volumes, ratios, angles;
  volumes.reserve(mesh.tets.size());
  ratios.reserve(mesh.tets.size());
  angles.reserve(6 * mesh.tets.size());
  TetQuality q;
  for (const sim::Tet& t : mesh.tets) {
    std::array<sim::Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.vertices[static_cast<std::size_t>(t[k])];
    volumes.push_back(sim::tet_volume(p[0], p[1], p[2], p[3]));
    q.volume += volumes.back();
    ratios.push_back(radius_ratio(p, volumes.back()));
    for (const auto& e : kEdges) {
      angles.push_back(dihedral(p[static_cast<std::size_t>(e[0])], p[static_cast<std::size_t>(e[1])],
                                p[static_cast<std::size_t>(e[2])], p[static_cast<std::size_t>(e[3])]));
    }
  }
  q.tets = static_cast<int>(mesh.tets.size());
  q.vertices = static_cast<int>(mesh.vertices.size());
  q.smallest_volume = *std::min_element(volumes.begin(), volumes.end());
  q.largest_volume = *std::max_element(volumes.begin(), volumes.end());
  q.worst_radius_ratio = *std::min_element(ratios.begin(), ratios.end());
  q.median_radius_ratio = median(ratios);
  q.min_dihedral = *std::min_element(angles.begin(), angles.end());
  q.max_dihedral = *std::max_element(angles.begin(), angles.end());
  q.median_dihedral = median(angles);
  return q;
}

}  // namespace softreel::assets
