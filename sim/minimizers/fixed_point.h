#pragma once
// Fixed-point iteration for an implicit step.
#include "sim/minimizer.h"

namespace softreel::sim {

/// y <- y_tilde - beta M^-1 grad E(y), which is y <- y - M^-1 g. Each iteration multiplies the error by up to
/// beta omega_max^2: it converges for h omega_max < 1 with implicit Euler, 2 with newmark and midpoint, 1.5 with bdf2.
/// An iteration that grows is detected, and the report says which step would do.
class FixedPoint final : public Minimizer {
 public:
  static constexpr MethodInfo kInfo = {"fixed-point", "no matrix; only for steps that explicit methods take as well",
                                       "1 gradient an iteration", "Hairer, Wanner 1996, section IV.8"};

  /// Throws std::invalid_argument for a line search or test that does not go with it.
  FixedPoint(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings);

 private:
  Failure begin() override;
  Failure advance(int iteration, Eigen::VectorXd& y, StepReport& report) override;
  Failure not_finite(const Failure&) const override { return diverges(); }
  std::string_view title() const override { return "fixed-point iteration"; }
  Failure diverges() const;

  double last_ = 0, factor_ = 0;  // |d|_M of the last iteration [kg^1/2 m]; of the one before it, by which it grew
  int growths_ = 0;               // in a row
  Eigen::VectorXd d_;
};

}  // namespace softreel::sim
