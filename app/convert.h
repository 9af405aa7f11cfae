#pragma once
// Between the types of the scene, the physics (double) and the picture (float).
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <glm/glm.hpp>
#include <vector>

#include "assets/scene.h"
#include "render/look.h"

namespace softreel::app {

inline glm::vec3 to_glm(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

inline glm::mat4 to_glm(const Eigen::Isometry3d& pose) {
  glm::mat4 m(1.0f);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r) m[c][r] = static_cast<float>(pose.matrix()(r, c));
  return m;
}

inline glm::vec3 to_srgb(const assets::Color& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

inline glm::vec3 to_linear(const assets::Color& c) { return render::linear_from_srgb(to_srgb(c)); }

/// Points [first, first + count) of a stacked vector.
std::vector<glm::vec3> points_of(const Eigen::VectorXd& x, int first, int count);

}  // namespace softreel::app
