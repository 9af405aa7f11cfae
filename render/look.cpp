#include "render/look.h"

#include <cmath>

namespace softreel::render {

glm::vec3 linear_from_srgb(const glm::vec3& srgb) {
  const auto decode = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
  return {decode(srgb.x), decode(srgb.y), decode(srgb.z)};
}

glm::vec3 linear_from_hex(unsigned hex) {
  return linear_from_srgb(glm::vec3((hex >> 16) & 255u, (hex >> 8) & 255u, hex & 255u) / 255.0f);
}

}  // namespace softreel::render
