#include "render/compare_images.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace softreel::render {

namespace {

constexpr int kHalf = kClusterWindow / 2;

/// Counts what differs in cells of half a window; four of them are a window.
class ClusterFinder {
 public:
  ClusterFinder(int width, int height)
      : width_(width),
        height_(height),
        columns_((width + kHalf - 1) / kHalf),
        rows_((height + kHalf - 1) / kHalf),
        counts_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(int x, int y) { ++counts_[index(x / kHalf, y / kHalf)]; }

  void find(ImageDifference& d) const {
    for (int row = 0; row < std::max(rows_ - 1, 1); ++row)
      for (int column = 0; column < std::max(columns_ - 1, 1); ++column) {
        int count = 0;
        for (int j = row; j < std::min(row + 2, rows_); ++j)
          for (int i = column; i < std::min(column + 2, columns_); ++i) count += counts_[index(i, j)];
        const int wide = std::min(kClusterWindow, width_ - column * kHalf);
        const int high = std::min(kClusterWindow, height_ - row * kHalf);
        const double part = static_cast<double>(count) / (wide * high);
        if (part <= d.cluster) continue;
        d.cluster = part;
        d.cluster_x = column * kHalf + wide / 2;
        d.cluster_y = row * kHalf + high / 2;
      }
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  int width_, height_, columns_, rows_;
  std::vector<int> counts_;
};

}  // namespace

ImageDifference compare(const Image& reference, const Image& actual) {
  ImageDifference d;
  d.same_size = reference.width == actual.width && reference.height == actual.height;
  if (!d.same_size) return d;
  d.pixels = reference.pixel_count();
  ClusterFinder clusters(reference.width, reference.height);
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(reference.width);
  std::size_t sum = 0;
  for (int y = 0; y < reference.height; ++y) {
    const std::uint8_t *a = reference.pixel(0, y), *b = actual.pixel(0, y);
    if (std::memcmp(a, b, row_bytes) == 0) continue;
    for (int x = 0; x < reference.width; ++x, a += 4, b += 4) {
      if (std::memcmp(a, b, 4) == 0) continue;
      int levels = 0;
      for (int channel = 0; channel < 4; ++channel) {
        const int difference = std::abs(a[channel] - b[channel]);
        levels = std::max(levels, difference);
        sum += static_cast<std::size_t>(difference);
      }
      ++d.differing_pixels;
      clusters.add(x, y);
      if (levels > d.max_levels) {
        d.max_levels = levels;
        d.worst_x = x;
        d.worst_y = y;
      }
    }
  }
  if (d.differing_pixels > 0) clusters.find(d);
  if (d.pixels > 0) d.mean_levels = static_cast<double>(sum) / (4.0 * static_cast<double>(d.pixels));
  return d;
}

void add_finer_differences(const std::vector<std::uint16_t>& reference, const std::vector<std::uint16_t>& actual,
                           ImageDifference& d) {
  for (std::size_t i = 0; i + 3 < std::min(reference.size(), actual.size()); i += 4) {
    bool coarse = false, fine = false;
    for (std::size_t c = i; c < i + 4; ++c) {
      coarse = coarse || reference[c] >> 8 != actual[c] >> 8;
      fine = fine || reference[c] != actual[c];
    }
    if (coarse || !fine) continue;
    ++d.differing_pixels;
    d.max_levels = std::max(d.max_levels, 1);
  }
}

std::size_t cover(const Image& reference, Image& actual, std::span<const PixelRectangle> rectangles) {
  std::vector<bool> covered(actual.pixel_count());
  std::size_t count = 0;
  for (const PixelRectangle& r : rectangles)
    for (int y = std::max(r.y, 0); y < actual.height && y - r.y < r.height; ++y)
      for (int x = std::max(r.x, 0); x < actual.width && x - r.x < r.width; ++x) {
        std::memcpy(actual.pixel(x, y), reference.pixel(x, y), 4);
        const auto i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(actual.width) + static_cast<std::size_t>(x);
        if (!covered[i]) ++count;
        covered[i] = true;
      }
  return count;
}

std::size_t cover(const Image& reference, Image& actual, const std::vector<std::uint16_t>& picture_ids,
                  const std::vector<int>& ids) {
  const int width = actual.width, height = actual.height;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  std::vector<bool> covered(actual.pixel_count());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (at(x, y) >= picture_ids.size()) continue;
      if (std::find(ids.begin(), ids.end(), picture_ids[at(x, y)]) == ids.end()) continue;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) covered[at(u, v)] = true;
    }
  std::size_t count = 0;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (!covered[i]) continue;
    std::memcpy(actual.rgba.data() + 4 * i, reference.rgba.data() + 4 * i, 4);
    ++count;
  }
  return count;
}

FlipFigures figures_of(const FlipMap& map) {
  FlipFigures f;
  f.pixels = map.error.size();
  f.mean = map.mean;
  f.max = static_cast<double>(map.max);
  f.max_x = map.max_x;
  f.max_y = map.max_y;
  f.visible_pixels = static_cast<std::size_t>(
      std::count_if(map.error.begin(), map.error.end(), [](float e) { return e > kVisibleError; }));
  return f;
}

}  // namespace softreel::render
