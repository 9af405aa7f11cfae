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

Light sun_light(const glm::vec3& direction, float angular_diameter, float intensity) {
  Light light;
  light.kind = LightKind::kSun;
  light.direction = direction;
  light.angular_diameter = angular_diameter;
  light.intensity = intensity;
  return light;
}

}  // namespace softreel::render
