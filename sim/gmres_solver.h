#pragma once
#include "sim/preconditioner.h"

namespace softreel::sim {

/// Restarted GMRES(m), preconditioned from the right: the least residual |b - A P^-1 u| over a Krylov space of up to m
/// vectors, then anew from there; so what it watches is the true residual (Saad, Schultz 1986; Saad 2003, section
/// 9.3.2). Needs neither symmetry nor definiteness; for positive definite A every cycle makes progress (without a
/// preconditioner), else it may stagnate, which it reports.
class GmresSolver final : public LinearSolver {
 public:
  /// Reads preconditioner, restart, max_iterations.
  explicit GmresSolver(const LinearSettings& settings = {});
  void analyse(const BlockMatrix& A) override { preconditioner_.analyse(A); }
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

 private:
  /// One cycle: x += P^-1 u, |b - A x| least, or below `goal`. Returns how many vectors it took; 0: A is singular.
  int cycle(double goal, Eigen::VectorXd& x);

  const BlockMatrix* A_ = nullptr;
  LazyPreconditioner preconditioner_;
  int restart_;
  long max_iterations_;
  std::vector<Eigen::VectorXd> V_;  // orthonormal basis of the Krylov space
  Eigen::MatrixXd R_;               // Hessenberg matrix, made triangular by rotations as it grows
  Eigen::VectorXd r_, z_, w_, cosine_, sine_, g_;
};

}  // namespace softreel::sim
