#include "render/light.h"

namespace softreel::render {

Light area_light(const glm::vec3& position, const glm::vec3& target, float radius, float intensity) {
  Light light;
  light.kind = LightKind::kSphere;
  light.position = position;
  light.radius = radius;
  light.reference_distance = glm::length(target - position);
  light.intensity = intensity;
  return light;
}

Light rectangle_light(const glm::vec3& position, const glm::vec3& target, const glm::vec2& size, float intensity) {
  Light light = area_light(position, target, 0, intensity);
  light.kind = LightKind::kRectangle;
  light.direction = target - position;
  light.size = size;
  return light;
}

Light sun_light(const glm::vec3& direction, float angular_diameter, float intensity) {
  Light light;
  light.kind = LightKind::kSun;
  light.direction = direction;
  light.angular_diameter = angular_diameter;
  light.intensity = intensity;
  return light;
}

}  // namespace softreel::render
