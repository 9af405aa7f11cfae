#pragma once
#include <Eigen/Cholesky>

#include "sim/multigrid_level.h"
#include "sim/preconditioner.h"

namespace softreel::sim {

/// One V-cycle of algebraic multigrid by smoothed aggregation (Vanek, Mandel, Brezina 1996): aggregates of
/// neighbouring vertices move like rigid bodies on the next level. One sweep of block Gauss-Seidel before the coarse
/// correction, the adjoint one after it, a direct solve on the coarsest level: so the cycle is symmetric positive
/// definite, and a contraction in the energy norm, for every positive definite A.
///
/// Without positions the aggregates only move in parallel, which leaves the bending of a body to more cycles.
class MultigridPreconditioner final : public Preconditioner {
 public:
  void analyse(const BlockMatrix&) override { analysed_ = false; }
  std::string factorize(const BlockMatrix& A, const LinearTargets& where) override;
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) override;
  std::size_t bytes() const override;

  /// Rows of blocks on every level, the finest first.
  std::vector<int> level_rows() const;

 private:
  void build_levels(const BlockView<3>& A, const LinearTargets& where);
  void cycle(size_t level);

  bool analysed_ = false;
  int fine_rows_ = 0;
  bool direct_ = false;  // so small that there is no coarser level
  MultigridLevel<3> finest_;
  std::vector<MultigridLevel<kModes>> coarser_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  std::vector<Eigen::VectorXd> r_, z_;  // of every level but the finest
};

}  // namespace softreel::sim
