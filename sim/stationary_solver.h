#pragma once
// The stationary iterations: A = P - N, and x += P^-1 (b - A x) until it stands.
#include "sim/convergence_watch.h"
#include "sim/linear_solver.h"

namespace softreel::sim {

/// The error obeys e' = (I - P^-1 A) e = P^-1 N e and the residual r' = (I - A P^-1) r = N P^-1 r (Saad 2003, section
/// 4.2): both shrink if and only if the spectral radius is below 1. A sweep is d = P^-1 r, x += d, r := N d; with
/// triangular P it takes as much as one product with A. What the methods differ in is P.
class StationarySolver : public LinearSolver {
 public:
  void analyse(const BlockMatrix&) final {}
  void factorize(const BlockMatrix& A) final;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) final;
  std::size_t bytes() const final;

 protected:
  StationarySolver(std::string_view name, const LinearSettings& settings);

  /// d := P^-1 r.
  virtual void solve_splitting(const Eigen::VectorXd& r, Eigen::VectorXd& d) const = 0;
  /// Nd := N d, N = P - A.
  virtual void multiply_rest(const Eigen::VectorXd& d, Eigen::VectorXd& Nd) const = 0;
  /// A norm of the residual in which the factor per sweep is watched.
  virtual double watched_norm(const Eigen::VectorXd& r) const = 0;
  /// Whether the radius is 1 or more, by what has been seen.
  virtual bool diverges(const ConvergenceWatch& watch) const = 0;
  /// What to say then.
  virtual std::string divergence(double radius) const = 0;

  const BlockMatrix& matrix() const { return *A_; }
  const Eigen::VectorXd& diagonal() const { return diagonal_; }  ///< of A, 3n

 private:
  std::string_view name_;
  long max_iterations_;
  const BlockMatrix* A_ = nullptr;
  Eigen::VectorXd diagonal_, r_, d_;
};

}  // namespace softreel::sim
