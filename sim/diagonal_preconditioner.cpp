#include "sim/diagonal_preconditioner.h"

#include <Eigen/LU>

#include "sim/linear_input.h"
#include "sim/parallel.h"

namespace softreel::sim {

std::string DiagonalPreconditioner::factorize(const BlockMatrix& A, const LinearTargets&) {
  inverse_.resize(9 * static_cast<size_t>(A.rows()));
  parallel_for(A.rows(), Work::kRow, [&](int i) {
    Eigen::Map<Eigen::Matrix3d> block(inverse_.data() + 9 * static_cast<size_t>(i));
    block = inverse(A.block(A.diagonal[static_cast<size_t>(i)]));
  });
  return {};
}

void DiagonalPreconditioner::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  z.resize(r.size());
  parallel_for(static_cast<int>(r.size()) / 3, Work::kVector, [&](int i) {
    const Eigen::Map<const Eigen::Matrix3d> block(inverse_.data() + 9 * static_cast<size_t>(i));
    z.segment<3>(3 * i) = block * r.segment<3>(3 * i);
  });
}

Eigen::Matrix3d BlockJacobiPreconditioner::inverse(const Eigen::Matrix3d& block) const { return block.inverse(); }

}  // namespace softreel::sim
