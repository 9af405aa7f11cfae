#pragma once
// Gradient descent on the incremental potential.
#include "sim/line_search.h"
#include "sim/minimizer.h"

namespace softreel::sim {

/// d = -P^-1 g, P the diagonal of M + beta H at rest: steepest descent in the metric of P, so that light and heavy
/// vertices go equally far (Nocedal and Wright 2006, section 3.3; in the plain metric the largest mass sets the pace).
class GradientDescent final : public Minimizer {
 public:
  static constexpr MethodInfo kInfo = {"gradient-descent", "no matrix; iterations grow with the stiffness times step^2",
                                       "1 gradient and some values an iteration", "Nocedal, Wright 2006, section 3.3"};

  GradientDescent(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings);

 private:
  Failure begin() override;
  Failure advance(int iteration, Eigen::VectorXd& y, StepReport& report) override;
  std::string_view title() const override { return "gradient descent"; }
  std::string_view advice() const override { return "; on stiff bodies it needs thousands: take newton"; }

  LineSearch search_;
  double first_ = 1;  // step that the line search tries first
  Eigen::VectorXd diagonal_, d_;
};

}  // namespace softreel::sim
