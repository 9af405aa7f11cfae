#include "sim/single_matrix.h"

#include "sim/block_rows.h"
#include "sim/parallel.h"

namespace softreel::sim {

void SingleMatrix::set(const BlockMatrix& A) {
  A_ = &A;
  values_.resize(9 * A.column.size() + 1);
  parallel_for(A.rows(), Work::kRow, [&](int i) {
    const auto row = static_cast<size_t>(i);
    for (int k = 9 * A.row_start[row]; k < 9 * A.row_start[row + 1]; ++k)
      values_[static_cast<size_t>(k)] = static_cast<float>(A.values[static_cast<size_t>(k)]);
  });
}

void SingleMatrix::multiply_rows(int first, int count, const Eigen::VectorXf& x, Eigen::VectorXf& y) const {
  multiply_block_rows(A_->row_start, A_->column, values_.data(), first, count, x.data(), y.data());
}

}  // namespace softreel::sim
