#pragma once
#include "sim/stationary_solver.h"

namespace softreel::sim {

/// Successive over-relaxation, P = D/omega + L (L: below the diagonal). For 0 < omega < 2 it converges for every
/// positive definite A (Ostrowski 1954), for other omega for no A (Kahan 1958). Sequential: each unknown uses those
/// before it.
class SorSolver : public StationarySolver {
 public:
  /// Reads omega; throws std::invalid_argument outside (0, 2).
  explicit SorSolver(const LinearSettings& settings = {}) : SorSolver("sor", settings.omega, settings) {}

 protected:
  SorSolver(std::string_view name, double omega, const LinearSettings& settings);

 private:
  void solve_splitting(const Eigen::VectorXd& r, Eigen::VectorXd& d) const final;
  void multiply_rest(const Eigen::VectorXd& d, Eigen::VectorXd& Nd) const final;
  double watched_norm(const Eigen::VectorXd& r) const final;
  bool diverges(const ConvergenceWatch& watch) const final;
  std::string divergence(double radius) const final;

  std::string_view name_;
  double omega_;
};

}  // namespace softreel::sim
