#pragma once
// How a body of points and edges is drawn.
#include <Eigen/Core>
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/surface_mesh.h"
#include "sim/mesh.h"

namespace softreel::app {

/// A ball at each point, a rod along each edge. A rod's cross-section is its frame at rest, turned by the smallest
/// rotation that takes the edge's direction at rest to that of now: the picture of a state depends on nothing but the
/// state, and no rod twists.
class BallsAndRods {
 public:
  /// `rest`: the points, [m]; `radii`: one for each.
  BallsAndRods(std::vector<sim::Vec3> rest, std::vector<std::array<int, 2>> edges, std::vector<double> radii,
               double edge_radius);

  render::SurfaceMesh mesh() const;
  /// Of the mesh, for points [first, first + rest.size()) of the stacked vector x.
  std::vector<glm::vec3> positions(const Eigen::VectorXd& x, int first) const;
  const std::vector<double>& radii() const { return radii_; }

 private:
  int corners() const { return static_cast<int>(ball_.size()); }

  std::vector<sim::Vec3> rest_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<double> radii_;
  double edge_radius_;
  int around_;                   // corners of a rod's cross-section
  std::vector<sim::Vec3> ball_;  // of radius 1
  std::vector<glm::uvec3> ball_triangles_;
};

}  // namespace softreel::app
