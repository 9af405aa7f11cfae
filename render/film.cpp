#include "render/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "render/environment.h"

namespace softreel::render {

namespace {

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Exact rounding without a power per pixel: for every interval of 1 / kSteps the byte at its beginning, then the first
/// linear value of each byte decides.
class SrgbTable {
 public:
  SrgbTable() {
    for (int byte = 1; byte < 256; ++byte) first_[byte] = static_cast<float>(srgb_decode((byte - 0.5) / 255));
    first_[0] = 0;
    first_[256] = 2;
    for (int i = 0; i <= kSteps; ++i)
      start_[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_encode(static_cast<double>(i) / kSteps)));
  }
  std::uint8_t byte(float linear) const {
    if (!(linear > 0)) return 0;  // NaN as well
    if (linear >= 1) return 255;
    int byte = start_[static_cast<int>(linear * kSteps)];
    while (linear >= first_[byte + 1]) ++byte;
    while (linear < first_[byte]) --byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<float, 257> first_{};
  std::array<std::uint8_t, kSteps + 1> start_{};
};

const SrgbTable kSrgb;

}  // namespace

glm::vec3 tone_curve(const glm::vec3& radiance) {
  constexpr float kStart = 0.8f - 0.04f;
  constexpr float kDesaturation = 0.15f;
  const float low = std::min({radiance.x, radiance.y, radiance.z});
  const float offset = low < 0.08f ? low - 6.25f * low * low : 0.04f;
  glm::vec3 color = radiance - offset;
  const float peak = std::max({color.x, color.y, color.z});
  if (peak < kStart) return color;
  constexpr float kRoom = 1 - kStart;
  const float new_peak = 1 - kRoom * kRoom / (peak + kRoom - kStart);
  color *= new_peak / peak;
  const float white = 1 - 1 / (kDesaturation * (peak - new_peak) + 1);
  return color + (glm::vec3(new_peak) - color) * white;
}

std::uint8_t srgb_byte(float linear) { return kSrgb.byte(linear); }

namespace {

/// A pixel that is partly or wholly in the picture's own colours.
void develop_display(const glm::vec4& pixel, const glm::vec4& display, const Environment& environment,
                     const glm::vec3& background, std::uint8_t* out) {
  const float own = std::clamp(display.w, 0.0f, 1.0f);
  const float lit = std::clamp(pixel.w, 0.0f, 1.0f - own);
  glm::vec3 color = glm::max(glm::vec3(display), 0.0f);
  if (lit > 0) color += lit * tone_curve(glm::max(glm::vec3(pixel) / pixel.w, 0.0f) * environment.exposure);
  const float alpha = own + lit;
  color = environment.transparent ? color / alpha : color + background * (1 - alpha);
  for (int c = 0; c < 3; ++c) out[c] = kSrgb.byte(color[c]);
  out[3] = environment.transparent ? static_cast<std::uint8_t>(std::lround(255 * alpha)) : 255;
}

/// Rows [first, last) of the picture.
void develop_rows(const FloatImage& film, const Environment& environment, std::size_t first, std::size_t last,
                  Image& image) {
  const auto width = static_cast<std::size_t>(film.width);
  for (std::size_t y = first; y < last; ++y) {
    const float down = (static_cast<float>(y) + 0.5f) / static_cast<float>(film.height);
    const glm::vec3 background = glm::mix(environment.background_top, environment.background_bottom, down);
    const std::array<std::uint8_t, 3> background_bytes{kSrgb.byte(background.x), kSrgb.byte(background.y),
                                                       kSrgb.byte(background.z)};
    for (std::size_t x = 0; x < width; ++x) {
      const glm::vec4& pixel = film.rgba[y * width + x];
      std::uint8_t* out = image.rgba.data() + 4 * (y * width + x);
      const float alpha = std::clamp(pixel.w, 0.0f, 1.0f);
      if (!film.display.empty() && film.display[y * width + x].w > 0) {
        develop_display(pixel, film.display[y * width + x], environment, background, out);
        continue;
      }
      out[3] = environment.transparent ? static_cast<std::uint8_t>(std::lround(255 * alpha)) : 255;
      if (!(alpha > 0)) {
        for (std::size_t c = 0; c < 3; ++c) out[c] = environment.transparent ? 0 : background_bytes[c];
        continue;
      }
      const glm::vec3 drawn = tone_curve(glm::max(glm::vec3(pixel) / alpha, 0.0f) * environment.exposure);
      const glm::vec3 color = environment.transparent ? drawn : drawn * alpha + background * (1 - alpha);
      for (int c = 0; c < 3; ++c) out[c] = kSrgb.byte(color[c]);
    }
  }
}

}  // namespace

Image develop(const FloatImage& film, const Environment& environment) {
  Image image = Image::blank(film.width, film.height);
  const auto height = static_cast<std::size_t>(film.height);
  // Pixels do not depend on one another: the bits are the same with any number of threads.
  const std::size_t parts = image.pixel_count() < 100000 ? 1 : std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
  std::vector<std::jthread> threads;
  for (std::size_t part = 1; part < parts; ++part)
    threads.emplace_back(
        [&, part] { develop_rows(film, environment, height * part / parts, height * (part + 1) / parts, image); });
  develop_rows(film, environment, 0, height / parts, image);
  threads.clear();
  return image;
}

}  // namespace softreel::render
