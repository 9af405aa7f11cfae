#pragma once
// The scale of a field: which colour stands for which value. Drawn onto the finished picture, so that light and tone
// curve leave it alone.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/image.h"

namespace softreel::render {

struct ColorBar {
  std::size_t map = 0;       ///< of color_maps()
  double low = 0, high = 1;  ///< values of the first and last colour
  std::string label;         ///< over the bar, may be empty: quantity and unit, UTF-8
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within low..high, about `wanted` of them, and how they are
/// written: all with the same digits, with a common power of ten where numbers are very large or small.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> labels;
  std::string factor;  ///< "×10⁻⁶" over the bar, or empty
};
Ticks nice_ticks(double low, double high, int wanted);

/// Draws the bars at the right edge of the picture, the first one outermost. Sizes follow the picture's height.
void draw_color_bars(Image& image, std::span<const ColorBar> bars);

/// How much of a picture's right side they take [px].
int color_bars_width(int width, int height, std::span<const ColorBar> bars);

/// Where the coloured part of a bar lies, [left, right) x [top, bottom) [px]: `high` is at the top.
struct BarPlace {
  int left = 0, right = 0, top = 0, bottom = 0;
};
std::vector<BarPlace> color_bar_places(int width, int height, std::span<const ColorBar> bars);

}  // namespace softreel::render
