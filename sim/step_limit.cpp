#include "sim/step_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/stability.h"

namespace softreel::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Where the search begins and ends, as h omega: shorter steps than the first nobody could wait for, and methods that
// have a limit have it below the second.
constexpr double kShortest = 1e-9, kLongest = 1e4;

/// The largest h omega up to which `good` holds, on a grid of factors 1.25 refined by bisection.
template <class Good>
double last_good(const Good& good) {
  double lo = kShortest;
  if (!good(lo)) return 0;
  double hi = lo;
  while (true) {
    hi = 1.25 * lo;
    if (hi > kLongest) return kInfinity;
    if (!good(hi)) break;
    lo = hi;
  }
  while (hi - lo > 1e-6 * hi) {
    const double middle = 0.5 * (lo + hi);
    (good(middle) ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace

double log_growth(std::string_view integrator, const Oscillation& mode, double h, double duration) {
  if (!(mode.omega > 0) || !(duration > 0)) return 0;
  const double h_omega = h * mode.omega;
  const double of_a_step = std::log(spectral_radius(integrator, h_omega, mode.damping_ratio));
  // The two eigenvalues of a slow oscillation lie h omega apart, and rounding moves them by epsilon over that.
  const double rounding = 16 * std::numeric_limits<double>::epsilon() / std::min(h_omega, 1.0);
  return std::abs(of_a_step) <= rounding ? 0 : of_a_step * std::max(1.0, duration / h);
}

bool holds(std::string_view integrator, const Oscillation& mode, double h, double duration) {
  return log_growth(integrator, mode, h, duration) <= std::log(kMostGrowth);
}

double largest_step(std::string_view integrator, const Oscillation& mode, double duration) {
  if (!(mode.omega > 0) || !(duration > 0)) return kInfinity;
  return last_good([&](double w) { return holds(integrator, mode, w / mode.omega, duration); }) / mode.omega;
}

double largest_fixed_point_step(std::string_view integrator, const Oscillation& mode) {
  if (!(mode.omega > 0)) return kInfinity;
  return last_good([&](double w) { return fixed_point_rate(integrator, w, mode.damping_ratio) < 1; }) / mode.omega;
}

}  // namespace softreel::sim
