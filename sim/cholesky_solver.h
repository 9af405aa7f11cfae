#pragma once
#include "sim/cholmod_factor.h"

namespace softreel::sim {

/// Supernodal sparse Cholesky factorization A = L L^T.
class CholeskySolver final : public LinearSolver {
 public:
  void analyse(const BlockMatrix& A) override { factor_.analyse(A); }
  void factorize(const BlockMatrix& A) override { factor_.factorize(A); }
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override { return factor_.bytes(); }

  /// Floating-point operations of one factorization, nonzeros of the factor; counted by analyse.
  double factor_flops() const { return factor_.flops(); }
  double factor_nonzeros() const { return factor_.nonzeros(); }
  bool analysed() const { return factor_.analysed(); }

 private:
  CholmodFactor factor_{CholmodKind::kSupernodal};
};

}  // namespace softreel::sim
