#pragma once
// How much two pictures differ, in steps: same pixels, what another driver may do, different.
#include <cstddef>
#include <string_view>

#include "render/image.h"

namespace softreel::render {

enum class ImageVerdict {
  kSame,       ///< same size, same pixels
  kDriver,     ///< same size, at most kDriverLevels levels on at most kDriverFraction of the pixels
  kDifferent,  ///< anything else, another size included
};

inline constexpr int kDriverLevels = 3;           ///< of 255, in any channel
inline constexpr double kDriverFraction = 0.001;  ///< of all pixels

struct ImageDifference {
  bool same_size = false;
  std::size_t pixels = 0;            ///< compared (0 when the sizes differ)
  std::size_t differing_pixels = 0;  ///< with a difference in any channel, alpha included
  int max_levels = 0;                ///< largest difference of a channel, 0..255
  double mean_levels = 0;            ///< mean over all pixels and channels of the absolute difference
  int worst_x = 0, worst_y = 0;      ///< a pixel with max_levels (the first in reading order)
  ImageVerdict verdict = ImageVerdict::kDifferent;

  double differing_fraction() const {
    return pixels == 0 ? 0.0 : static_cast<double>(differing_pixels) / static_cast<double>(pixels);
  }
};

ImageDifference compare(const Image& reference, const Image& actual);

/// "same pixels", "within driver tolerance", "different".
std::string_view verdict_name(ImageVerdict verdict);

/// The reference in dimmed grey; over it every pixel that differs, from dark red (1 level) over yellow to white (64
/// levels and more). For pictures of different sizes: the larger size, what only one of them covers in blue.
Image difference_image(const Image& reference, const Image& actual);

}  // namespace softreel::render
