#pragma once
#include "sim/stationary_solver.h"

namespace softreel::sim {

/// P = D = diag(A). Converges for positive definite A if and only if 2 D - A is positive definite too, which on
/// tetrahedra it mostly is not: an element alone brings eigenvalues of D^-1 A up to 4.
class JacobiSolver final : public StationarySolver {
 public:
  explicit JacobiSolver(const LinearSettings& settings = {}) : StationarySolver("jacobi", settings) {}

 private:
  void solve_splitting(const Eigen::VectorXd& r, Eigen::VectorXd& d) const override;
  void multiply_rest(const Eigen::VectorXd& d, Eigen::VectorXd& Nd) const override;
  double watched_norm(const Eigen::VectorXd& r) const override;
  bool diverges(const ConvergenceWatch& watch) const override;
  std::string divergence(double radius) const override;
};

}  // namespace softreel::sim
