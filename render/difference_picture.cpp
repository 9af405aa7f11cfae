#include "render/difference_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace softreel::render {

namespace {

int levels_between(const std::uint8_t* a, const std::uint8_t* b) {
  int levels = 0;
  for (int channel = 0; channel < 4; ++channel) levels = std::max(levels, std::abs(a[channel] - b[channel]));
  return levels;
}

using Rgb = std::array<double, 3>;

/// Dark red at 1 level, over orange and yellow to white at 64 and more; logarithmic, so that a single level is seen.
Rgb heat(int levels) {
  const double t = std::min(std::log2(static_cast<double>(levels)) / 6.0, 1.0);
  return {std::min(0.55 + 1.35 * t, 1.0), std::clamp(1.5 * t - 0.15, 0.0, 1.0), std::clamp(4 * t - 3, 0.0, 1.0)};
}

void put(std::uint8_t* pixel, const Rgb& color) {
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::lround(255 * color[c]));
  pixel[3] = 255;
}

double dimmed_grey(const std::uint8_t* pixel) {
  return 0.45 * (0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]) / 255;
}

bool covers(const Image& image, int x, int y) { return x < image.width && y < image.height; }

}  // namespace

Image difference_picture(const Image& reference, const Image& actual) {
  Image picture = Image::blank(std::max(reference.width, actual.width), std::max(reference.height, actual.height));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      std::uint8_t* out = picture.pixel(x, y);
      if (!covers(reference, x, y) || !covers(actual, x, y)) {
        put(out, {0.10, 0.15, covers(reference, x, y) || covers(actual, x, y) ? 0.50 : 0.15});
        continue;
      }
      const std::uint8_t* a = reference.pixel(x, y);
      const int levels = levels_between(a, actual.pixel(x, y));
      if (levels > 0) {
        put(out, heat(levels));
      } else {
        const double grey = dimmed_grey(a);
        put(out, {grey, grey, grey});
      }
    }
  return picture;
}

}  // namespace softreel::render
