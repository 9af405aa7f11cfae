#include "sim/steepest_descent_solver.h"

#include "sim/convergence_watch.h"
#include "sim/linear_input.h"
#include "sim/parallel.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {

SteepestDescentSolver::SteepestDescentSolver(const LinearSettings& settings)
    : preconditioner_(settings.preconditioner), max_iterations_(settings.max_iterations) {}

void SteepestDescentSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  preconditioner_.set(A);
}

LinearReport SteepestDescentSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "steepest-descent";
  report.reason = preconditioner_.prepare(targets);
  if (!report.reason.empty()) {
    refuse(report, report.reason, *A_, b);
    return report;
  }
  x.setZero(b.size());
  r_ = b;
  ConvergenceWatch watch("steepest descent", max_iterations_);
  ResidualCheck check;
  watch.record(norm(r_));
  for (double left = excess(targets, r_);; left = excess(targets, r_)) {
    if (left <= 1) {
      const auto verdict = check(*A_, b, targets, x, r_);
      if (verdict == ResidualCheck::Verdict::kSolved) break;
      if (verdict == ResidualCheck::Verdict::kAtRounding) report.reason = kAtRounding;
    } else {
      report.reason = watch.verdict(left);
    }
    double slope = 0, curvature = 0;
    if (report.reason.empty()) {
      preconditioner_->apply(r_, z_);
      A_->multiply(z_, Az_);
      slope = dot(r_, z_);
      curvature = dot(z_, Az_);
      if (!(slope > 0) || !(curvature > 0)) report.reason = kNotPositiveDefinite;
    }
    if (!report.reason.empty()) {
      refuse(report, report.reason, *A_, b);
      return report;
    }
    const double alpha = slope / curvature;
    parallel_for(static_cast<int>(x.size()), Work::kVector, [&](int i) {
      x(i) += alpha * z_(i);
      r_(i) -= alpha * Az_(i);
    });
    watch.record(norm(r_));
    report.iterations = watch.iterations();
    report.rate = watch.rate();
  }
  report.ok = true;
  correct_rigid_modes(*A_, b, targets, x);
  return report;
}

std::size_t SteepestDescentSolver::bytes() const {
  return preconditioner_->bytes() + sizeof(double) * static_cast<size_t>(r_.size() + z_.size() + Az_.size());
}

}  // namespace softreel::sim
