#include "sim/block_matrix.h"

#include <cassert>

#include "sim/block_rows.h"
#include "sim/parallel.h"

namespace softreel::sim {

void BlockMatrix::multiply_rows(int first, int count, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  assert(values.size() > 9 * column.size());
  multiply_block_rows(row_start, column, values.data(), first, count, x.data(), y.data());
}

void BlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(3 * rows());
  parallel_for(rows(), Work::kRow, [&](int i) { multiply_rows(i, 1, x, y); });
}

}  // namespace softreel::sim
