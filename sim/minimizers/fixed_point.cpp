#include "sim/minimizers/fixed_point.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/mass.h"

namespace softreel::sim {
namespace {

constexpr int kGrowths = 3;  // so many times in a row the change has to grow before it counts as divergence

std::string digits(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return {text.data(), end};
}

}  // namespace

FixedPoint::FixedPoint(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings)
    : model_(model), phi_(phi), max_iterations_(settings.max_iterations), test_(model, phi, settings) {
  if (settings.line_search != "backtracking")
    throw std::invalid_argument("fixed-point iteration has no line search; leave it out, or take gradient-descent");
}

void FixedPoint::minimize(Eigen::VectorXd& y, StepReport& report) {
  const auto fail = [&](const std::string& why) {
    report.converged = false;
    report.reason = why;
  };
  if (phi_.stage().inertia == 0)
    return fail("fixed-point iteration divides by the mass, which does not count in an equilibrium");
  phi_.gradient(y, g_, report);
  test_.start(y, g_);
  double last = 0, factor = 0;
  int growths = 0;
  for (int iteration = 0;; ++iteration) {
    const bool stop_after_step = !test_.fired().empty();
    const std::string failure = test_.look(g_);
    if (failure.empty() && (stop_after_step || !test_.fired().empty())) {
      report.residual = std::max(report.residual, test_.residual());
      report.stopped_by = test_.fired();
      return;
    }
    if (growths == kGrowths || !failure.empty()) {
      // The factor is beta omega_max^2, and beta goes with the square of the step.
      const std::string times = factor > 1 ? digits(1.1 * std::sqrt(factor)) : "several";
      return fail("fixed-point iteration does not converge: each iteration multiplies the error by about " +
                  digits(std::max(factor, 1.0)) + " (beta omega_max^2, must be below 1); take a step " + times +
                  " times shorter, or newton");
    }
    if (iteration == max_iterations_)
      return fail("fixed-point iteration did not converge in " + std::to_string(iteration) + " iterations on '" +
                  test_.slowest() + "'");
    ++report.descent_iterations;
    d_ = -g_;
    phi_.mass().solve(d_);
    y += d_;
    const double change = std::sqrt(-g_.dot(d_));  // |d|_M
    if (iteration > 0) {
      factor = last > 0 ? change / last : 0;
      growths = factor > 1 ? growths + 1 : 0;
      // What is left after a step that converges linearly: factor/(1 - factor) of it.
      if (factor < 1) test_.look_at_step(y, std::max(1.0, factor / (1 - factor)) * d_, true);
    }
    last = change;
    phi_.gradient(y, g_, report);
  }
}

}  // namespace softreel::sim
