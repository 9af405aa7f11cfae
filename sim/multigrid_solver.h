#pragma once
#include "sim/multigrid_preconditioner.h"

namespace softreel::sim {

/// V-cycles of smoothed aggregation, one after the other: x += P^-1 (b - A x), with P^-1 of multigrid_preconditioner.h.
/// Converges for every positive definite A.
class MultigridSolver final : public LinearSolver {
 public:
  explicit MultigridSolver(const LinearSettings& settings = {});
  void analyse(const BlockMatrix& A) override { cycle_.analyse(A); }
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

 private:
  const BlockMatrix* A_ = nullptr;
  LazyPreconditioner cycle_{"multigrid"};
  long max_iterations_;
  Eigen::VectorXd r_, z_;
};

}  // namespace softreel::sim
