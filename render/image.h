#pragma once
// Pictures in memory.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace softreel::render {

/// 8-bit RGBA picture, rows from top to bottom, no padding, straight alpha, sRGB.
struct Image {
  int width = 0;                   ///< [px]
  int height = 0;                  ///< [px]
  std::vector<std::uint8_t> rgba;  ///< width * height * 4

  /// All zero. Throws std::invalid_argument for a size below 1 or above kMaxImageSide.
  static Image blank(int width, int height);
  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() +
           4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  std::uint8_t* pixel(int x, int y) { return const_cast<std::uint8_t*>(static_cast<const Image*>(this)->pixel(x, y)); }
  bool operator==(const Image&) const = default;
};

inline constexpr int kMaxImageSide = 16384;  ///< [px]

}  // namespace softreel::render
