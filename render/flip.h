#pragma once
// LDR-FLIP: how much a person who alternates between two pictures sees them differ, pixel by pixel.
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: FLIP, A Difference Evaluator for Alternating
// Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), article 15, 2020.
#include <vector>

#include "render/image.h"

namespace softreel::render {

/// How far the picture is looked at from. Pixels per degree of visual angle; the default is the paper's: a display 0.7
/// m wide with 3840 pixels, seen from 0.7 m.
struct FlipView {
  double pixels_per_degree = 67.0206432766;  ///< > 0
};

/// Pixels of a degree on a display `width` [m] wide with `pixels` across, seen from `distance` [m].
double pixels_per_degree(double distance, double width, int pixels);

struct FlipMap {
  int width = 0, height = 0;  ///< [px]
  std::vector<float> error;   ///< width * height, 0 (no visible difference) .. 1
  double mean = 0;            ///< the paper's one figure for two pictures
  float max = 0;
  int max_x = 0, max_y = 0;  ///< [px] a pixel with it, the first in reading order
};

/// Both pictures sRGB and of one size (std::invalid_argument otherwise), transparent pixels over mid grey. The same
/// bits for any number of `threads` (>= 1: strips of rows). Time and memory do not depend on what is in the pictures.
FlipMap flip(const Image& reference, const Image& test, const FlipView& view = {}, int threads = 1);

}  // namespace softreel::render
