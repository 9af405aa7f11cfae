#pragma once
// The filters of FLIP, as one-dimensional kernels whose products are the two-dimensional ones of the paper.
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: FLIP, A Difference Evaluator for Alternating
// Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; sections 4.1 (contrast sensitivity) and 4.2 (features).
#include <vector>

namespace softreel::render {

/// Weights at distance 0, 1, 2, ... from the middle [px]; even: w(-k) = w(k), odd: w(-k) = -w(k).
struct HalfKernel {
  std::vector<float> weights;
  bool odd = false;
  int radius() const { return static_cast<int>(weights.size()) - 1; }
};

struct FlipFilters {
  /// Contrast sensitivity of the channels Yy, Cx, Cz (table 1 of the paper); each product of two sums to 1.
  HalfKernel achromatic, red_green, blue_yellow_wide, blue_yellow_narrow;
  float wide_part = 0;  ///< of the blue-yellow filter: its value is wide_part * wide + (1 - wide_part) * narrow
  /// Gaussian of half the width of a feature (0.082 degrees), its first derivative (edges) and its second (points); the
  /// positive weights of a derivative sum to 1, the negative ones to -1.
  HalfKernel smooth, edge, point;
  int radius = 0;  ///< [px] of the widest
};

/// `pixels_per_degree` > 0: of visual angle.
FlipFilters flip_filters(double pixels_per_degree);

}  // namespace softreel::render
