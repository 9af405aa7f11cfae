#pragma once
// Lights that stand in the scene. The sky is in environment.h.
#include <glm/glm.hpp>

namespace softreel::render {

enum class LightKind {
  kSphere,     ///< a glowing ball at a place
  kSun,        ///< far away: parallel but for its angular size
  kRectangle,  ///< a glowing rectangle at a place; shines to the side that it faces, with the cosine
};

/// Strength is given by its effect: a white matte surface that faces the light (at `reference_distance` from a sphere
/// or before a rectangle) has radiance `intensity * color`; 1 is the white of the picture at exposure 1.
struct Light {
  LightKind kind = LightKind::kSphere;
  glm::vec3 position{3, 5, 2};     ///< kSphere, kRectangle: centre, world [m]
  float radius = 0.5f;             ///< kSphere: [m], >= 0; 0 gives hard shadows
  float reference_distance = 0;    ///< where `intensity` holds [m], but for suns; light falls off with the distance
                                   ///< squared. 0: no falloff, the same strength everywhere
  glm::vec3 direction{0, -1, 0};   ///< kSun, kRectangle: from the light into the scene, any length but zero
  float angular_diameter = 0.53f;  ///< kSun: [degrees]; the real sun has 0.53
  glm::vec2 size{1, 1};            ///< kRectangle: width (level) and height [m], >= 0
  glm::vec3 color{1, 1, 1};        ///< linear
  float intensity = 1;             ///< >= 0
  bool casts_shadow = true;        ///< without, no shadow map is made for it
  bool operator==(const Light&) const = default;
};

/// A sphere light whose `intensity` holds at `target`.
Light area_light(const glm::vec3& position, const glm::vec3& target, float radius, float intensity = 1);
/// A rectangle light that faces `target`, where its `intensity` holds.
Light rectangle_light(const glm::vec3& position, const glm::vec3& target, const glm::vec2& size, float intensity = 1);
Light sun_light(const glm::vec3& direction, float angular_diameter, float intensity = 1);

}  // namespace softreel::render
