#include "sim/stationary_solver.h"

#include <cmath>
#include <string>

#include "sim/linear_input.h"
#include "sim/parallel.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {

StationarySolver::StationarySolver(std::string_view name, const LinearSettings& settings)
    : name_(name), max_iterations_(settings.max_iterations) {}

void StationarySolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  diagonal_.resize(3 * A.rows());
  for (int i = 0; i < A.rows(); ++i)
    diagonal_.segment<3>(3 * i) = A.block(A.diagonal[static_cast<size_t>(i)]).diagonal();
}

LinearReport StationarySolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = name_;
  if (!(diagonal_.array() > 0).all()) {
    refuse(report, std::string(kNotPositiveDefinite) + ": its diagonal is not positive", *A_, b);
    return report;
  }
  x.setZero(b.size());
  r_ = b;
  d_.resize(b.size());
  ConvergenceWatch watch(std::string(name_), max_iterations_);
  ResidualCheck check;
  watch.record(watched_norm(r_));
  for (double left = excess(targets, r_);; left = excess(targets, r_)) {
    if (left <= 1) {
      const auto verdict = check(*A_, b, targets, x, r_);
      if (verdict == ResidualCheck::Verdict::kSolved) break;
      if (verdict == ResidualCheck::Verdict::kAtRounding) report.reason = kAtRounding;
    } else if (diverges(watch)) {
      report.reason = divergence(watch.factor());
    } else {
      report.reason = watch.verdict(left);
    }
    if (!report.reason.empty()) {
      refuse(report, report.reason, *A_, b);
      return report;
    }
    solve_splitting(r_, d_);
    parallel_for(static_cast<int>(x.size()), Work::kVector, [&](int i) { x(i) += d_(i); });
    multiply_rest(d_, r_);
    watch.record(watched_norm(r_));
    report.iterations = watch.iterations();
    report.rate = watch.factor();
  }
  report.ok = true;
  correct_rigid_modes(*A_, b, targets, x);
  return report;
}

std::size_t StationarySolver::bytes() const {
  return sizeof(double) * static_cast<size_t>(diagonal_.size() + r_.size() + d_.size());
}

}  // namespace softreel::sim
