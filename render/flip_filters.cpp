#include "render/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softreel::render {

namespace {

constexpr double kFeatureWidth = 0.082;  // [degrees] section 4.2: what the eye detects best
constexpr double kNothing = 1e-9;  // weights whose sum is below this part of the whole are left out: float cannot tell

/// One term a sqrt(pi / b) exp(-pi^2 r^2 / b) of the contrast sensitivity in space; r in degrees.
struct Term {
  double a, b;
};
constexpr Term kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053}, kBlueYellowWide{34.1, 0.04},
    kBlueYellowNarrow{13.5, 0.025};

double sigma_of(const Term& term) { return std::sqrt(term.b / 2) / std::numbers::pi; }  // [degrees]

/// Both halves together.
double whole(const std::vector<double>& half) {
  double sum = half[0];
  for (std::size_t k = 1; k < half.size(); ++k) sum += 2 * half[k];
  return sum;
}

std::vector<double> gaussian(double sigma, int radius) {
  std::vector<double> half;
  for (int k = 0; k <= radius; ++k) half.push_back(std::exp(-k * k / (2 * sigma * sigma)));
  return half;
}

HalfKernel rounded(std::vector<double> half, double scale, bool odd = false) {
  double left_out = 0;
  while (half.size() > 1 && left_out + 2 * std::abs(half.back() * scale) < kNothing) {
    left_out += 2 * std::abs(half.back() * scale);
    half.pop_back();
  }
  HalfKernel kernel;
  kernel.odd = odd;
  for (const double w : half) kernel.weights.push_back(static_cast<float>(w * scale));
  return kernel;
}

HalfKernel unit_sum(const std::vector<double>& half) { return rounded(half, 1 / whole(half)); }

/// Positive and negative weights scaled apart, to sums of 1 and -1.
HalfKernel second_derivative(double sigma, int radius) {
  std::vector<double> half = gaussian(sigma, radius);
  for (int k = 0; k <= radius; ++k) half[static_cast<std::size_t>(k)] *= k * k / (sigma * sigma) - 1;
  double positive = 0, negative = 0;
  for (std::size_t k = 0; k < half.size(); ++k) (half[k] > 0 ? positive : negative) += (k == 0 ? 1 : 2) * half[k];
  for (double& w : half) w /= w > 0 ? positive : -negative;
  return rounded(half, 1);
}

HalfKernel first_derivative(double sigma, int radius) {
  std::vector<double> half = gaussian(sigma, radius);
  double positive = 0;
  for (int k = 0; k <= radius; ++k) positive += half[static_cast<std::size_t>(k)] *= k;
  return rounded(half, 1 / positive, true);
}

}  // namespace

FlipFilters flip_filters(double pixels_per_degree) {
  FlipFilters f;
  // One radius for all channels, three standard deviations of the widest.
  const int radius = static_cast<int>(std::ceil(3 * sigma_of(kBlueYellowWide) * pixels_per_degree));
  const auto sensitivity = [&](const Term& t) { return gaussian(sigma_of(t) * pixels_per_degree, radius); };
  f.achromatic = unit_sum(sensitivity(kAchromatic));
  f.red_green = unit_sum(sensitivity(kRedGreen));
  f.blue_yellow_wide = unit_sum(sensitivity(kBlueYellowWide));
  f.blue_yellow_narrow = unit_sum(sensitivity(kBlueYellowNarrow));
  const auto weight = [&](const Term& t) {
    const double side = whole(sensitivity(t));
    return t.a * std::sqrt(std::numbers::pi / t.b) * side * side;
  };
  f.wide_part = static_cast<float>(weight(kBlueYellowWide) / (weight(kBlueYellowWide) + weight(kBlueYellowNarrow)));

  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int feature_radius = static_cast<int>(std::ceil(3 * sigma));
  f.smooth = unit_sum(gaussian(sigma, feature_radius));
  f.edge = first_derivative(sigma, feature_radius);
  f.point = second_derivative(sigma, feature_radius);
  f.radius = std::max(radius, feature_radius);
  return f;
}

}  // namespace softreel::render
