#pragma once
#include <memory>

#include "sim/linear_solver.h"

namespace softreel::sim {

/// Sparse multifrontal factorization P A Q = L U with partial pivoting (UMFPACK, Davis 2004). Needs neither symmetry
/// nor definiteness, and pays for that about twice what symmetric factorizations take.
class LuSolver final : public LinearSolver {
 public:
  LuSolver();
  ~LuSolver() override;
  void analyse(const BlockMatrix& A) override;
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softreel::sim
