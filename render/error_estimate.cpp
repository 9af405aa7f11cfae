#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace softreel::render {

namespace {

constexpr std::size_t kMostPixels = 100000;

float srgb_encode(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// What `develop` makes of a pixel, before it is rounded. sRGB 0..1.
glm::vec3 shown(const FloatImage& film, std::size_t pixel, const Environment& environment, const glm::vec3& behind) {
  const glm::vec4& drawn = film.rgba[pixel];
  const float alpha = std::clamp(drawn.w, 0.0f, 1.0f);
  glm::vec3 color(0);
  if (alpha > 0) color = alpha * tone_curve(glm::max(glm::vec3(drawn) / alpha, 0.0f) * environment.exposure);
  float covered = alpha;
  if (!film.display.empty()) {
    color += glm::max(glm::vec3(film.display[pixel]), 0.0f);
    covered += film.display[pixel].w;
  }
  color = glm::clamp(color + behind * std::max(1 - covered, 0.0f), 0.0f, 1.0f);
  return {srgb_encode(color.x), srgb_encode(color.y), srgb_encode(color.z)};
}

}  // namespace

double shown_difference(const FloatImage& a, const FloatImage& b, const Environment& environment) {
  const glm::vec3 behind = 0.5f * (environment.background_top + environment.background_bottom);
  // An odd stride goes through all columns.
  const std::size_t stride = (a.rgba.size() / kMostPixels) | 1;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += stride) {
    const glm::vec3 d = shown(a, i, environment, behind) - shown(b, i, environment, behind);
    sum += static_cast<double>(glm::dot(d, d)) / 3;
    ++count;
  }
  return count == 0 ? 0 : 255 * std::sqrt(sum / static_cast<double>(count));
}

double halves_error(const FloatImage& first, const FloatImage& second, const Environment& environment) {
  return 0.5 * shown_difference(first, second, environment);
}

}  // namespace softreel::render
