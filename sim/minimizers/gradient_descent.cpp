#include "sim/minimizers/gradient_descent.h"

#include "sim/parallel.h"

namespace softreel::sim {

GradientDescent::GradientDescent(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings)
    : Minimizer(model, phi, settings), search_(phi, settings.line_search) {}

Minimizer::Failure GradientDescent::begin() {
  const Stage& stage = phi_.stage();
  diagonal_ = stage.inertia * model_.masses + stage.beta * phi_.stiffness();
  first_ = 1;
  return {};
}

Minimizer::Failure GradientDescent::advance(int, Eigen::VectorXd& y, StepReport& report) {
  ++report.descent_iterations;
  d_.resize(y.size());
  parallel_for(model_.vertices(), Work::kVector,
               [&](int i) { d_.segment<3>(3 * i) = -g_.segment<3>(3 * i) / diagonal_(i); });
  const double length = search_.along(d_, g_.dot(d_), test_.value_rounding(), first_, y, report);
  if (length == 0) return "the line search found no lower energy";
  first_ = 2 * length;
  return {};
}

}  // namespace softreel::sim
