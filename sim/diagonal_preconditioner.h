#pragma once
// Preconditioners that are 3x3 blocks on the diagonal.
#include "sim/preconditioner.h"

namespace softreel::sim {

class DiagonalPreconditioner : public Preconditioner {
 public:
  std::string factorize(const BlockMatrix& A, const LinearTargets&) final;
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) final;
  const double* diagonal_blocks() const final { return inverse_.data(); }
  std::size_t bytes() const final { return sizeof(double) * inverse_.size(); }

 protected:
  /// What the block (i, i) of A becomes in P^-1.
  virtual Eigen::Matrix3d inverse(const Eigen::Matrix3d& block) const = 0;

 private:
  std::vector<double> inverse_;  // 9 doubles per block
};

/// P = I.
class NoPreconditioner final : public DiagonalPreconditioner {
  Eigen::Matrix3d inverse(const Eigen::Matrix3d&) const override { return Eigen::Matrix3d::Identity(); }
};

/// P = diag(A).
class JacobiPreconditioner final : public DiagonalPreconditioner {
  Eigen::Matrix3d inverse(const Eigen::Matrix3d& block) const override {
    return block.diagonal().cwiseInverse().asDiagonal();
  }
};

/// P = the blocks (i, i) of A.
class BlockJacobiPreconditioner final : public DiagonalPreconditioner {
  Eigen::Matrix3d inverse(const Eigen::Matrix3d& block) const override;
};

}  // namespace softreel::sim
