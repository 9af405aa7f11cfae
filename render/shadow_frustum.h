#pragma once
// Which way a shadow map looks, and how its numbers are to be read.
#include <glm/glm.hpp>
#include <span>

#include "render/bounds.h"
#include "render/pass_uniforms.h"

namespace softreel::render {

struct ShadowFrustum {
  glm::mat4 clip_from_world{1};  ///< OpenGL clip space
  ShadowUniforms uniforms;
};

/// A map seen from `point` that holds all the casters' boxes (world). `part_radius`: of the disc around the point that
/// the map stands for [m]. Casters nearer than a thousandth of the farthest, or more than 80 degrees off the axis (a
/// light amid the bodies), are cut off.
ShadowFrustum frustum_from_point(const glm::vec3& point, std::span<const Bounds> casters, int map_size,
                                 float part_radius);

/// A map of parallel light. `towards_light`: unit. `part_tangent`: tangent of the angular radius of the part of the
/// light that it stands for.
ShadowFrustum frustum_along(const glm::vec3& towards_light, std::span<const Bounds> casters, int map_size,
                            float part_tangent);

}  // namespace softreel::render
