#include "sim/block_matrix.h"

#include <algorithm>
#include <cassert>

#include "sim/block_rows.h"
#include "sim/parallel.h"

namespace softreel::sim {

int BlockMatrix::find(int i, int j) const {
  const auto begin = column.begin() + row_start[static_cast<size_t>(i)];
  const auto end = column.begin() + row_start[static_cast<size_t>(i) + 1];
  const auto it = std::lower_bound(begin, end, j);
  return it != end && *it == j ? static_cast<int>(it - column.begin()) : -1;
}

void BlockMatrix::multiply_rows(int first, int count, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  assert(values.size() > 9 * column.size());
  multiply_block_rows(row_start, column, values.data(), first, count, x.data(), y.data());
}

void BlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(3 * rows());
  parallel_for(rows(), Work::kRow, [&](int i) { multiply_rows(i, 1, x, y); });
}

}  // namespace softreel::sim
