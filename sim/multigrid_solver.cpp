#include "sim/multigrid_solver.h"

#include "sim/convergence_watch.h"
#include "sim/linear_input.h"
#include "sim/parallel.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {

MultigridSolver::MultigridSolver(const LinearSettings& settings) : max_iterations_(settings.max_iterations) {}

void MultigridSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  cycle_.set(A);
}

LinearReport MultigridSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "multigrid";
  report.reason = cycle_.prepare(targets);
  if (!report.reason.empty()) {
    refuse(report, report.reason, *A_, b);
    return report;
  }
  x.setZero(b.size());
  r_ = b;
  ConvergenceWatch watch("multigrid", max_iterations_);
  watch.record(norm(r_));
  for (double left = excess(targets, r_); !(left <= 1); left = excess(targets, r_)) {
    report.reason = watch.verdict(left);
    // A contraction in the energy norm for every positive definite A: growth beyond its square root of the condition
    // number disproves that.
    if (watch.growth() > 1e6) report.reason = std::string(kNotPositiveDefinite) + ": multigrid diverges";
    if (!report.reason.empty()) {
      refuse(report, report.reason, *A_, b);
      return report;
    }
    cycle_->apply(r_, z_);
    parallel_for(static_cast<int>(x.size()), Work::kVector, [&](int i) { x(i) += z_(i); });
    residual_of(*A_, b, x, r_);
    watch.record(norm(r_));
    report.iterations = watch.iterations();
    report.rate = watch.rate();
  }
  report.ok = true;
  correct_rigid_modes(*A_, b, targets, x);
  return report;
}

std::size_t MultigridSolver::bytes() const {
  return cycle_->bytes() + sizeof(double) * static_cast<size_t>(r_.size() + z_.size());
}

}  // namespace softreel::sim
