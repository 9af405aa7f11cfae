#include "sim/minimizers/gradient_descent.h"

#include <algorithm>

#include "sim/parallel.h"

namespace softreel::sim {

GradientDescent::GradientDescent(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings)
    : model_(model),
      phi_(phi),
      max_iterations_(settings.max_iterations),
      test_(model, phi, settings),
      search_(phi, settings.line_search) {}

void GradientDescent::minimize(Eigen::VectorXd& y, StepReport& report) {
  const auto fail = [&](const std::string& why) {
    report.converged = false;
    report.reason = why;
  };
  const Stage& stage = phi_.stage();
  const Eigen::VectorXd diagonal = stage.inertia * model_.masses + stage.beta * phi_.stiffness();
  phi_.gradient(y, g_, report);
  test_.start(y, g_);
  double first = 1;  // step that the line search tries first
  for (int iteration = 0;; ++iteration) {
    const bool stop_after_step = !test_.fired().empty();
    const std::string failure = test_.look(g_);
    if (!failure.empty()) return fail(failure);
    if (stop_after_step || !test_.fired().empty()) {
      report.residual = std::max(report.residual, test_.residual());
      report.stopped_by = test_.fired();
      return;
    }
    if (iteration == max_iterations_)
      return fail("gradient descent did not converge in " + std::to_string(iteration) + " iterations on '" +
                  test_.slowest() + "'; on stiff bodies it needs thousands: take newton");
    ++report.descent_iterations;
    d_.resize(y.size());
    parallel_for(model_.vertices(), Work::kVector,
                 [&](int i) { d_.segment<3>(3 * i) = -g_.segment<3>(3 * i) / diagonal(i); });
    const double length = search_.along(d_, g_.dot(d_), test_.value_rounding(), first, y, report);
    if (length == 0) return fail("the line search found no lower energy");
    first = 2 * length;
    phi_.gradient(y, g_, report);
  }
}

}  // namespace softreel::sim
