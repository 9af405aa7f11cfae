#include "render/shadow_frustum.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace softreel::render {

namespace {

constexpr double kWidestTangent = 5.67;  // of 80 degrees

glm::dmat4 view_along(const glm::dvec3& position, const glm::dvec3& forward) {
  const glm::dvec3 up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  return glm::lookAt(position, position + forward, up);
}

template <typename Visit>
void for_each_corner(std::span<const Bounds> boxes, const glm::dmat4& view, Visit visit) {
  for (const Bounds& box : boxes)
    for (int corner = 0; corner < 8; ++corner)
      visit(glm::dvec3(view * glm::dvec4((corner & 1) != 0 ? box.high.x : box.low.x,
                                         (corner & 2) != 0 ? box.high.y : box.low.y,
                                         (corner & 4) != 0 ? box.high.z : box.low.z, 1)));
}

/// Rectangle across the view, grown a little so that the map's rim stays empty.
struct Window {
  glm::dvec2 low{1e300};
  glm::dvec2 high{-1e300};
  void add(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void grow(int map_size, double least) {
    const glm::dvec2 margin = glm::max((high - low) * (3.0 / map_size), glm::dvec2(least));
    low -= margin;
    high += margin;
  }
};

ShadowFrustum finish(const glm::dmat4& projection, const glm::dmat4& view, const Window& window, double near,
                     double far, bool perspective, int map_size, float part) {
  const glm::dmat4 clip = projection * view;
  const glm::dmat4 map_from_clip =
      glm::translate(glm::dmat4(1), glm::dvec3(0.5)) * glm::scale(glm::dmat4(1), glm::dvec3(0.5));
  const glm::dmat4 map = map_from_clip * clip;
  const glm::dvec2 size = window.high - window.low;
  ShadowFrustum result;
  result.clip_from_world = glm::mat4(clip);
  result.uniforms.map_from_world = glm::mat4(map);
  result.uniforms.plane_from_world = glm::mat4(glm::transpose(glm::inverse(map)));
  result.uniforms.filter =
      glm::vec4(1 / size.x, 1 / size.y, std::max(size.x, size.y) / map_size, static_cast<double>(part));
  result.uniforms.depth = glm::vec4(near, far, perspective ? 1 : 0, 0);
  return result;
}

}  // namespace

ShadowFrustum frustum_from_point(const glm::vec3& point, std::span<const Bounds> casters, int map_size,
                                 float part_radius) {
  Bounds all;
  for (const Bounds& box : casters) all.add(box);
  const glm::dvec3 eye(point);
  glm::dvec3 forward = glm::dvec3(all.centre()) - eye;
  forward = glm::length(forward) > 1e-6 ? glm::normalize(forward) : glm::dvec3(0, -1, 0);
  const glm::dmat4 view = view_along(eye, forward);

  double near = 1e300;
  double far = -1e300;
  for_each_corner(casters, view, [&](const glm::dvec3& corner) {
    near = std::min(near, -corner.z);
    far = std::max(far, -corner.z);
  });
  far = std::max(far * 1.001, 1e-5);
  near = std::max(near * 0.999, far * 1e-3);
  Window window;
  for_each_corner(casters, view, [&](const glm::dvec3& corner) {
    const double depth = std::max(-corner.z, near);
    window.add(glm::clamp(glm::dvec2(corner) / depth, glm::dvec2(-kWidestTangent), glm::dvec2(kWidestTangent)));
  });
  window.grow(map_size, 1e-5);
  const glm::dmat4 projection =
      glm::frustum(window.low.x * near, window.high.x * near, window.low.y * near, window.high.y * near, near, far);
  return finish(projection, view, window, near, far, true, map_size, part_radius);
}

ShadowFrustum frustum_along(const glm::vec3& towards_light, std::span<const Bounds> casters, int map_size,
                            float part_tangent) {
  Bounds all;
  for (const Bounds& box : casters) all.add(box);
  const double radius = std::max(1.01 * static_cast<double>(all.radius()), 1e-4);
  const glm::dvec3 back = glm::normalize(glm::dvec3(towards_light));
  const glm::dmat4 view = view_along(glm::dvec3(all.centre()) + 2 * radius * back, -back);
  Window window;
  double near = 1e300;
  double far = -1e300;
  for_each_corner(casters, view, [&](const glm::dvec3& corner) {
    window.add(glm::dvec2(corner));
    near = std::min(near, -corner.z);
    far = std::max(far, -corner.z);
  });
  near -= 0.01 * radius;
  far += 0.01 * radius;
  window.grow(map_size, 1e-4 * radius);
  const glm::dmat4 projection = glm::ortho(window.low.x, window.high.x, window.low.y, window.high.y, near, far);
  return finish(projection, view, window, near, far, false, map_size, part_tangent);
}

}  // namespace softreel::render
