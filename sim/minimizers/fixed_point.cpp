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
    : Minimizer(model, phi, settings) {
  if (settings.line_search != "backtracking")
    throw std::invalid_argument("fixed-point iteration has no line search; leave it out, or take gradient-descent");
}

Minimizer::Failure FixedPoint::begin() {
  last_ = factor_ = 0;
  growths_ = 0;
  if (phi_.stage().inertia == 0)
    return "fixed-point iteration divides by the mass, which does not count in an equilibrium";
  return {};
}

Minimizer::Failure FixedPoint::diverges() const {
  // The factor is beta omega_max^2, and beta goes with the square of the step.
  const std::string times = factor_ > 1 ? digits(1.1 * std::sqrt(factor_)) : "several";
  return "fixed-point iteration does not converge: each iteration multiplies the error by about " +
         digits(std::max(factor_, 1.0)) + " (beta omega_max^2, must be below 1); take a step " + times +
         " times shorter, or newton";
}

Minimizer::Failure FixedPoint::advance(int iteration, Eigen::VectorXd& y, StepReport& report) {
  ++report.descent_iterations;
  d_ = -g_;
  phi_.mass().solve(d_);
  y += d_;
  const double change = std::sqrt(-g_.dot(d_));  // |d|_M
  if (iteration > 0) {
    factor_ = last_ > 0 ? change / last_ : 0;
    growths_ = factor_ > 1 ? growths_ + 1 : 0;
    // What is left after a step that converges linearly: factor/(1 - factor) of it.
    if (factor_ < 1) test_.look_at_step(y, std::max(1.0, factor_ / (1 - factor_)) * d_, true);
  }
  last_ = change;
  return growths_ == kGrowths ? diverges() : Failure{};
}

}  // namespace softreel::sim
