#include "sim/line_search.h"

#include <algorithm>
#include <cmath>

#include "sim/method_table.h"

namespace softreel::sim {
namespace {

constexpr double kArmijo = 1e-4;
constexpr double kFlatter = 0.9;
constexpr double kShortestStep = 1e-10;
constexpr double kExactSlope = 1e-3;  // of the first, at which an exact search ends
constexpr int kMostEvaluations = 60;  // of an exact search
constexpr double kFarthest = 1e6;     // times the first step

struct Entry {
  MethodInfo info;
  bool exact;
};
constexpr std::array kLineSearches = {
    Entry{{"backtracking", "halves the step until the energy falls enough", "1 value a trial",
           "Nocedal, Wright 2006, section 3.1"},
          false},
    Entry{{"exact", "minimum along the direction", "1 gradient a trial", "Dowell, Jarratt 1971"}, true},
};

}  // namespace

Catalogue line_searches() { return catalogue_of<kLineSearches>(); }

LineSearch::LineSearch(IncrementalPotential& phi, const std::string& name)
    : phi_(phi), exact_(find_method(kLineSearches, name, "line search").exact) {}

double LineSearch::along(const Eigen::VectorXd& d, double slope, double rounding, double first, Eigen::VectorXd& y,
                         StepReport& report) {
  const Start start{phi_.value(y, report), slope, rounding};
  if (exact_) {
    const double step = exact(d, start, first, y, report);
    if (step > 0) {
      trial_ = y + step * d;
      if (acceptable(d, start, step, report)) {
        y.swap(trial_);
        return step;
      }
    }
  }
  return backtrack(d, start, first, y, report);
}

/// Looks at trial_ = y + step d.
bool LineSearch::acceptable(const Eigen::VectorXd& d, const Start& start, double step, StepReport& report) {
  const double phi = phi_.value(trial_, report);
  if (!std::isfinite(phi)) return false;
  if (phi <= start.value + kArmijo * step * start.slope) return true;
  if (phi > start.value + start.rounding) return false;
  phi_.gradient(trial_, trial_gradient_, report);
  return std::abs(trial_gradient_.dot(d)) <= kFlatter * -start.slope;
}

double LineSearch::backtrack(const Eigen::VectorXd& d, const Start& start, double first, Eigen::VectorXd& y,
                             StepReport& report) {
  for (double step = phi_.max_step(y, first * d, report) * first; step > kShortestStep * first; step *= 0.5) {
    trial_ = y + step * d;
    if (!acceptable(d, start, step, report)) continue;
    y.swap(trial_);
    return step;
  }
  return 0;
}

double LineSearch::slope_at(const Eigen::VectorXd& y, const Eigen::VectorXd& d, double step, StepReport& report) {
  trial_ = y + step * d;
  phi_.gradient(trial_, trial_gradient_, report);
  return trial_gradient_.dot(d);
}

/// Zero of the slope: doubles the step until it is passed, then false position in between.
double LineSearch::exact(const Eigen::VectorXd& d, const Start& start, double first, const Eigen::VectorXd& y,
                         StepReport& report) {
  double lo = 0, lo_slope = start.slope;
  double hi = phi_.max_step(y, first * d, report) * first;
  const double limit = hi < first ? hi : kFarthest * first;  // a step cut by max_step goes no further
  double hi_slope = slope_at(y, d, hi, report);
  int evaluations = 1;
  while (hi_slope < 0 && hi < limit) {
    lo = hi, lo_slope = hi_slope;
    hi = std::min(2 * hi, limit);
    if (phi_.max_step(y, hi * d, report) < 1) return lo;
    hi_slope = slope_at(y, d, hi, report);
    if (++evaluations == kMostEvaluations) return lo;
  }
  if (hi_slope <= 0) return hi;
  for (int side = 0; evaluations < kMostEvaluations; ++evaluations) {
    // Where the far end is not finite there is nothing to interpolate.
    const double middle = std::isfinite(hi_slope) ? (lo * hi_slope - hi * lo_slope) / (hi_slope - lo_slope) : NAN;
    const double step = middle > lo && middle < hi ? middle : 0.5 * (lo + hi);
    const double slope = slope_at(y, d, step, report);
    if (std::abs(slope) <= kExactSlope * -start.slope) return step;
    if (slope < 0) {
      lo = step, lo_slope = slope;
      if (side == -1) hi_slope *= 0.5;  // Illinois: an end that stays loses weight
      side = -1;
    } else {
      hi = step, hi_slope = slope;
      if (side == 1) lo_slope *= 0.5;
      side = 1;
    }
  }
  return lo;
}

}  // namespace softreel::sim
