#pragma once
// How much two pictures differ, in figures.
#include <cstddef>
#include <span>
#include <vector>

#include "render/flip.h"
#include "render/image.h"

namespace softreel::render {

inline constexpr int kClusterWindow = 16;  ///< [px] see ImageDifference::cluster

struct ImageDifference {
  bool same_size = false;
  std::size_t pixels = 0;            ///< compared (0 when the sizes differ)
  std::size_t differing_pixels = 0;  ///< with a difference in any channel, alpha included
  int max_levels = 0;                ///< largest difference of a channel, 0..255
  double mean_levels = 0;            ///< mean over all pixels and channels of the absolute difference
  int worst_x = 0, worst_y = 0;      ///< a pixel with max_levels (the first in reading order)
  /// The largest part of a window of kClusterWindow x kClusterWindow pixels that differs, over windows at every half of
  /// that distance; of a smaller picture, of the picture.
  double cluster = 0;
  int cluster_x = 0, cluster_y = 0;  ///< middle of that window

  double differing_fraction() const {
    return pixels == 0 ? 0.0 : static_cast<double>(differing_pixels) / static_cast<double>(pixels);
  }
};

ImageDifference compare(const Image& reference, const Image& actual);

/// For pictures with 16 bits a channel, whose upper 8 bits were compared: counts the pixels that differ below them
/// only, as differences of one level. `reference`, `actual`: 4 values a pixel, of the same size.
void add_finer_differences(const std::vector<std::uint16_t>& reference, const std::vector<std::uint16_t>& actual,
                           ImageDifference& difference);

/// Where a part of the pictures does not count.
struct PixelRectangle {
  int x = 0, y = 0, width = 0, height = 0;  ///< [px] from the left top corner
};

/// Makes the covered pixels of `actual` those of `reference`, so that nothing differs there by any measure. Rectangles
/// may reach beyond the pictures, which have one size. The number of covered pixels.
std::size_t cover(const Image& reference, Image& actual, std::span<const PixelRectangle> rectangles);

/// The same for every pixel whose id is one of `ids`, and the eight around it: a body adds to each pixel that its edge
/// is less than one away from (the filter of sampling.h). `picture_ids`: one per pixel.
std::size_t cover(const Image& reference, Image& actual, const std::vector<std::uint16_t>& picture_ids,
                  const std::vector<int>& ids);

/// From here on a pixel of a FLIP map counts as visibly different. Two large patches at the distance d of CIELab have
/// the error 0.95 d^0.7 / (0.4 * 41.276): 0.1 is d = 2.2, about the difference that is just noticeable (2.3: Mahy, Van
/// Eycken, Oosterlinck, Color Research & Application 19(2), 1994).
inline constexpr float kVisibleError = 0.1f;

struct FlipFigures {
  std::size_t pixels = 0;
  double mean = 0;                 ///< 0..1
  double max = 0;                  ///< 0..1
  int max_x = 0, max_y = 0;        ///< [px]
  std::size_t visible_pixels = 0;  ///< with an error above kVisibleError
};
FlipFigures figures_of(const FlipMap& map);

}  // namespace softreel::render
