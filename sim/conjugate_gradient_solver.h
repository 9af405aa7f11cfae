#pragma once
#include "sim/preconditioner.h"

namespace softreel::sim {

/// Preconditioned conjugate gradients, ended by a projection onto the rigid modes (rigid_modes.h).
class ConjugateGradientSolver final : public LinearSolver {
 public:
  /// Reads preconditioner and max_iterations (0: 10 times the number of unknowns, at least 1000).
  explicit ConjugateGradientSolver(const LinearSettings& settings = {});
  void analyse(const BlockMatrix& A) override { preconditioner_.analyse(A); }
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

  /// Gives up after so many iterations; 0: as in the constructor.
  void set_max_iterations(long n) { max_iterations_ = n; }

 private:
  const BlockMatrix* A_ = nullptr;
  LazyPreconditioner preconditioner_;
  long max_iterations_ = 0;
  Eigen::VectorXd r_, z_, p_, Ap_;
};

}  // namespace softreel::sim
