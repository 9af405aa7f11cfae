#pragma once
// Axis-aligned boxes around what is drawn.
#include <glm/glm.hpp>
#include <limits>
#include <span>

namespace softreel::render {

/// Axis-aligned box in world space [m]. A new one is empty: it contains nothing and grows with `add`.
struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};

  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  glm::vec3 centre() const { return 0.5f * (low + high); }
  /// Half the diagonal [m]; 0 when empty.
  float radius() const { return empty() ? 0.0f : 0.5f * glm::length(high - low); }
  void add(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  void add(std::span<const glm::vec3> points) {
    for (const glm::vec3& point : points) add(point);
  }
};

}  // namespace softreel::render
