#pragma once
#include "sim/preconditioner.h"

namespace softreel::sim {

/// IC(0) in 3x3 blocks: L has blocks where the lower triangle of A has, and L L^T equals A there. Where a pivot does
/// not come out positive, A + shift diag(A) is factorized instead, the shift doubled until it holds: a large one makes
/// the matrix diagonally dominant (Manteuffel 1980; Lin, More 1999, section 4). Rows are eliminated in the order of the
/// vertices, one after the other.
class IncompleteCholesky final : public Preconditioner {
 public:
  void analyse(const BlockMatrix&) override { start_.clear(); }
  std::string factorize(const BlockMatrix& A, const LinearTargets&) override;
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) override;
  std::size_t bytes() const override;

  double shift() const { return shift_; }  ///< of the last factorization, relative to the diagonal; 0: none

 private:
  void copy_pattern(const BlockMatrix& A);
  bool factorize_shifted(const BlockMatrix& A, double shift);

  std::vector<int> start_, column_;  // strictly lower blocks by rows
  std::vector<double> lower_;        // 9 doubles each
  std::vector<double> inverse_;      // of the diagonal blocks of L, lower triangular, 9 doubles each
  double shift_ = 0;
};

}  // namespace softreel::sim
