#pragma once
// When a minimizer may stop.
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "sim/incremental_potential.h"
#include "sim/minimizer_settings.h"

namespace softreel::sim {

/// The names of `MinimizerSettings::stop`. All are relative to the motion that the step has to produce, so they hold
/// for stiff bodies too, where a step of 1e-6 m is the whole answer:
///   residual:  |g| <= tolerance |g0| for every body, g0 the gradient at the start of the solve;
///   decrement: lambda <= tolerance lambda_0, lambda^2 = g^T H^-1 g the Newton decrement, lambda_0 the first one;
///   step:      |d| <= tolerance |y - y_0| for every body, d the last full step; judged after it was taken.
/// Whichever is chosen, a gradient below rounding, 16 eps |(M + beta H) |y|| for every body, ends the solve: a body at
/// rest converges at once.
enum class StoppingTest { kResidual, kDecrement, kStep };

class ConvergenceTest {
 public:
  /// Throws std::invalid_argument for an unknown name in settings.stop.
  ConvergenceTest(const Model& model, const IncrementalPotential& phi, const MinimizerSettings& settings);

  /// Begins a solve at y with gradient g, which its tolerance is relative to.
  void start(const Eigen::VectorXd& y, const Eigen::VectorXd& g);
  /// Takes the scale of rounding from the matrix where the iteration is, contact and damping included.
  void see_hessian(const BlockMatrix& H, const Eigen::VectorXd& y);

  /// Forgets what has fired, not what tolerances are relative to.
  void restart() { fired_ = {}; }

  /// Looks at the gradient where the iteration is. Returns what is wrong with it, or nothing.
  std::string look(const Eigen::VectorXd& g);
  /// Looks at a direction that is about to be taken; slope = g.d < 0.
  void look_at_slope(double slope);
  /// Looks at the step d, after it led to y at its full length (`full`) or cut short.
  void look_at_step(const Eigen::VectorXd& y, const Eigen::VectorXd& d, bool full);

  /// Which test has fired, or nothing.
  std::string_view fired() const { return fired_; }
  /// |g|/|g0| of the worst body, where forces are above rounding.
  double residual() const { return residual_; }
  /// The body farthest from its target.
  const std::string& slowest() const;
  /// Rounding of the function's value [kg m^2].
  double value_rounding() const { return value_rounding_; }
  /// Per body, the gradient beyond which a linear solve need not go: where the residual test fires; the others judge
  /// what a solve gives, which has to be there, down to rounding.
  const std::vector<double>& linear_targets() const { return test_ == StoppingTest::kResidual ? targets_ : floors_; }
  /// Is the measure taken where `start` was called, whatever the first direction starts from? Not that of the
  /// decrement.
  bool measured_at_start() const { return test_ != StoppingTest::kDecrement; }

  std::vector<double> body_norms(const Eigen::VectorXd& g) const;

 private:
  void set_floors(const Eigen::VectorXd& y);

  const Model& model_;
  const IncrementalPotential& phi_;
  StoppingTest test_;
  double tolerance_;
  Eigen::VectorXd y0_, diagonal_;  // diagonal_: per vertex, the largest entry of M + beta H [kg]
  std::vector<double> g0_, norms_, floors_, targets_;
  double value_rounding_ = 0, residual_ = 0, first_decrement_ = 0;
  std::string_view fired_;
};

}  // namespace softreel::sim
