#include "sim/contact/free_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softreel::sim {
namespace {

// Pieces are shortened by this for what rounding adds to distances and products.
constexpr double kCaution = 0.9;
// Grazing paths take ever shorter pieces; after so many the rest is left to the next step.
constexpr int kMostPieces = 256;
// Distances are computed to some units in the last place of the coordinates.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

double free_path(PairKind kind, const FourPoints& x, const FourPoints& p, double offset, double enough) {
  const Eigen::Vector3d mean = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  double speed[4], size = 0;
  for (size_t i = 0; i < 4; ++i) {
    speed[i] = (p[i] - mean).norm();
    size = std::max(size, x[i].cwiseAbs().maxCoeff());
  }
  const double fastest = kind == PairKind::kPointTriangle ? speed[0] + std::max({speed[1], speed[2], speed[3]})
                                                          : std::max(speed[0], speed[1]) + std::max(speed[2], speed[3]);
  if (fastest == 0) return 1;
  double gap = pair_distance(kind, x) - offset;
  if (!(gap > kRounding * size)) return 0;
  const double kept = kKeptGap * gap;
  double s = 0;
  for (int piece = 0; piece < kMostPieces; ++piece) {
    const double length = kCaution * (gap - kept) / fastest;
    if (s + length >= enough) return std::min(1.0, s + length);
    FourPoints at;
    for (size_t i = 0; i < 4; ++i) at[i] = x[i] + (s + length) * (p[i] - mean);
    gap = pair_distance(kind, at) - offset;
    s += length;
    // Pieces that bring less than a hundredth of the way that is already safe are not worth their work.
    if (gap - kept < 0.1 * kept) break;
  }
  return s;
}

}  // namespace softreel::sim
