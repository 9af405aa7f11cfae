#pragma once
#include "sim/preconditioner.h"

namespace softreel::sim {

/// x += alpha z, z = P^-1 r, r = b - A x, alpha = r^T z / z^T A z: the lowest energy along z. With preconditioner
/// "none" alpha = r^T r / r^T A r. Per step the energy norm of the error shrinks by (kappa - 1) / (kappa + 1) or more,
/// kappa the condition number of P^-1 A (Kantorovich; Saad 2003, theorem 5.9), and in the long run hardly by more.
class SteepestDescentSolver final : public LinearSolver {
 public:
  explicit SteepestDescentSolver(const LinearSettings& settings = {});
  void analyse(const BlockMatrix& A) override { preconditioner_.analyse(A); }
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

 private:
  const BlockMatrix* A_ = nullptr;
  LazyPreconditioner preconditioner_;
  long max_iterations_;
  Eigen::VectorXd r_, z_, Az_;
};

}  // namespace softreel::sim
