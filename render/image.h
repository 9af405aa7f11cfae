#pragma once
// Pictures in memory.
#include <cstdint>
#include <vector>

namespace softreel::render {

/// 8-bit RGBA picture, rows from top to bottom, no padding, straight alpha, sRGB.
struct Image {
  int width = 0;                   ///< [px]
  int height = 0;                  ///< [px]
  std::vector<std::uint8_t> rgba;  ///< width * height * 4

  static Image blank(int width, int height);
};

}  // namespace softreel::render
