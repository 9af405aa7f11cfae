#pragma once
// What a step tells: whether it holds, why not, what it took.
#include <string>
#include <string_view>

namespace softreel::sim {

/// Wall seconds of a step's stages; they add up to `total`.
struct StageSeconds {
  double gradient = 0, assemble = 0, solve = 0, contact = 0, total = 0;
  double other() const { return total - gradient - assemble - solve - contact; }
};

struct StepReport {
  bool converged = true;
  std::string reason;  ///< why not, for the user, if not converged
  long steps = 0;      ///< accepted steps (more than one if the step was halved)
  long retries = 0;    ///< steps thrown away and taken again in halves
  long newton_iterations = 0;
  long descent_iterations = 0;  ///< of gradient descent or fixed-point iteration
  long linear_iterations = 0;
  long hessians = 0;             ///< element Hessian evaluations, over all terms
  long contact_evaluations = 0;  ///< evaluations of the contact term
  long stiffenings = 0;          ///< solves taken again with stiffer contact between surfaces
  double residual = 0;           ///< worst |g|/|g0| of a body at the end of a solve (0: at rest from the start)
  double dissipated = 0;         ///< work of the dissipation potentials [J]
  std::string_view solver;       ///< linear solver that was chosen last
  std::string_view stopped_by;   ///< the test that ended the last solve: residual, decrement, step or rounding
  StageSeconds seconds;

  /// Adds the counts and seconds of a further step; its verdict replaces this one's.
  void add(const StepReport& next) {
    converged = next.converged;
    reason = next.reason;
    steps += next.steps;
    retries += next.retries;
    newton_iterations += next.newton_iterations;
    descent_iterations += next.descent_iterations;
    linear_iterations += next.linear_iterations;
    hessians += next.hessians;
    contact_evaluations += next.contact_evaluations;
    stiffenings += next.stiffenings;
    residual = residual > next.residual ? residual : next.residual;
    dissipated += next.dissipated;
    if (!next.solver.empty()) solver = next.solver;
    if (!next.stopped_by.empty()) stopped_by = next.stopped_by;
    seconds.gradient += next.seconds.gradient;
    seconds.assemble += next.seconds.assemble;
    seconds.solve += next.seconds.solve;
    seconds.contact += next.seconds.contact;
    seconds.total += next.seconds.total;
  }
};

}  // namespace softreel::sim
