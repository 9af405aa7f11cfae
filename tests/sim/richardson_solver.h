#pragma once
// Richardson's iteration: x += (b - A x)/alpha (Richardson 1910; Saad 2003, section 4.2.1).
#include <algorithm>

#include "sim/convergence_watch.h"
#include "sim/linear_input.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {

/// The residual obeys r' = (I - A/alpha) r. With alpha the largest sum of absolute values in a row, no eigenvalue of A
/// is above alpha (Gershgorin 1931), so this converges for every positive definite A.
class RichardsonSolver final : public LinearSolver {
 public:
  explicit RichardsonSolver(const LinearSettings& settings = {}) : max_iterations_(settings.max_iterations) {}

  void analyse(const BlockMatrix&) override {}

  void factorize(const BlockMatrix& A) override {
    A_ = &A;
    alpha_ = 0;
    for (size_t i = 0; i + 1 < A.row_start.size(); ++i) {
      Eigen::Vector3d sums = Eigen::Vector3d::Zero();
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k) sums += A.block(k).cwiseAbs().rowwise().sum();
      alpha_ = std::max(alpha_, sums.maxCoeff());
    }
  }

  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override {
    LinearReport report;
    report.chosen = "richardson";
    x.setZero(b.size());
    r_ = b;
    ConvergenceWatch watch("richardson", max_iterations_);
    watch.record(norm(r_));
    for (double left = excess(targets, r_); !(left <= 1); left = excess(targets, r_)) {
      report.reason = watch.verdict(left);
      // Under powers of a symmetric matrix the factor from one to the next never falls: one above 1 is proof.
      if (watch.factor() > 1 + 1e-10) report.reason = kNotPositiveDefinite;
      if (!report.reason.empty()) {
        refuse(report, report.reason, *A_, b);
        return report;
      }
      x += r_ / alpha_;
      residual_of(*A_, b, x, r_);
      watch.record(norm(r_));
      report.iterations = watch.iterations();
      report.rate = watch.rate();
    }
    report.ok = true;
    correct_rigid_modes(*A_, b, targets, x);
    return report;
  }

  std::size_t bytes() const override { return sizeof(double) * static_cast<size_t>(r_.size()); }

 private:
  const BlockMatrix* A_ = nullptr;
  long max_iterations_;
  double alpha_ = 0;  // at least the largest eigenvalue of A
  Eigen::VectorXd r_;
};

}  // namespace softreel::sim
