#include "app/balls_and_rods.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "app/convert.h"
#include "render/surface_mesh.h"

namespace softreel::app {

using sim::Vec3;

BallsAndRods::BallsAndRods(std::vector<Vec3> rest, std::vector<std::array<int, 2>> edges, std::vector<double> radii,
                           double edge_radius)
    : rest_(std::move(rest)), edges_(std::move(edges)), radii_(std::move(radii)), edge_radius_(edge_radius) {
  constexpr size_t kFew = 200;  // so many points are drawn round, more of them rounder than a pixel shows
  around_ = rest_.size() <= kFew ? 16 : 8;
  const render::Shape ball = render::make_sphere(1, rest_.size() <= kFew ? 32 : 14);
  for (const glm::vec3& p : ball.positions) ball_.emplace_back(p.x, p.y, p.z);
  for (const glm::uvec3& t : ball.mesh.triangles)
    ball_triangles_.emplace_back(ball.mesh.position_of[t.x], ball.mesh.position_of[t.y], ball.mesh.position_of[t.z]);
}

render::SurfaceMesh BallsAndRods::mesh() const {
  std::vector<glm::uvec3> triangles;
  unsigned first = 0;
  for (size_t i = 0; i < rest_.size(); ++i, first += static_cast<unsigned>(corners()))
    for (const glm::uvec3& t : ball_triangles_) triangles.push_back(t + first);
  const auto n = static_cast<unsigned>(around_);
  for (size_t e = 0; e < edges_.size(); ++e, first += 2 * n)
    for (unsigned k = 0; k < n; ++k) {  // ring at the one end: first + k, at the other: first + n + k
      const unsigned next = (k + 1) % n;
      triangles.emplace_back(first + k, first + next, first + n + k);
      triangles.emplace_back(first + next, first + n + next, first + n + k);
    }
  return render::mesh_from_triangles(first, triangles);
}

std::vector<glm::vec3> BallsAndRods::positions(const Eigen::VectorXd& x, int first) const {
  std::vector<glm::vec3> result;
  result.reserve(rest_.size() * ball_.size() + 2 * edges_.size() * static_cast<size_t>(around_));
  const auto point = [&](int i) { return Vec3(x.segment<3>(3 * (first + i))); };
  for (size_t i = 0; i < rest_.size(); ++i)
    for (const Vec3& corner : ball_) result.push_back(to_glm(Vec3(point(static_cast<int>(i)) + radii_[i] * corner)));
  for (const auto& [i, j] : edges_) {
    const Vec3 p = point(i), q = point(j);
    Vec3 along = rest_[static_cast<size_t>(j)] - rest_[static_cast<size_t>(i)];
    if (!(along.norm() > 0)) along = Vec3::UnitY();
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if ((q - p).norm() > 0) turn = Eigen::Quaterniond::FromTwoVectors(along, q - p).toRotationMatrix();
    const Vec3 side = along.unitOrthogonal();
    const Vec3 u = edge_radius_ * (turn * side), w = edge_radius_ * (turn * along.normalized().cross(side));
    for (const Vec3& end : {p, q})
      for (int k = 0; k < around_; ++k) {
        const double angle = 2 * std::numbers::pi * k / around_;
        result.push_back(to_glm(Vec3(end + std::cos(angle) * u + std::sin(angle) * w)));
      }
  }
  return result;
}

}  // namespace softreel::app
