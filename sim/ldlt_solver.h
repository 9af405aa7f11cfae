#pragma once
#include "sim/cholmod_factor.h"

namespace softreel::sim {

/// Sparse factorization A = L D L^T, D diagonal. Needs no positive pivots, so it solves with negative definite and many
/// indefinite matrices too; but it does not pivot, so there the residual decides whether the answer is one.
class LdltSolver final : public LinearSolver {
 public:
  void analyse(const BlockMatrix& A) override { factor_.analyse(A); }
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

 private:
  CholmodFactor factor_{CholmodKind::kSimplicial};
  const BlockMatrix* A_ = nullptr;
  Eigen::VectorXd r_;
};

}  // namespace softreel::sim
