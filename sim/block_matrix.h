#pragma once
// Sparse symmetric matrix of 3x3 blocks, stored in full (both triangles), so that a product runs row by row.
#include <Eigen/Core>
#include <vector>

namespace softreel::sim {

struct BlockMatrix {
  std::vector<int> row_start;  ///< n + 1 offsets into `column`
  std::vector<int> column;     ///< block column indices, increasing within a row
  std::vector<int> diagonal;   ///< position of block (i, i)
  std::vector<double> values;  ///< 9 doubles per block, column-major; room for one more at the end

  long pattern = 0;  ///< another number, another sparsity pattern

  int rows() const { return static_cast<int>(diagonal.size()); }  ///< block rows n
  Eigen::Map<Eigen::Matrix3d> block(int k) { return Eigen::Map<Eigen::Matrix3d>(values.data() + 9 * size_t(k)); }
  Eigen::Map<const Eigen::Matrix3d> block(int k) const {
    return Eigen::Map<const Eigen::Matrix3d>(values.data() + 9 * size_t(k));
  }

  /// Position of block (i, j), or -1.
  int find(int i, int j) const;

  /// Block rows [first, first + count) of y = A x.
  void multiply_rows(int first, int count, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// y = A x, both 3n; the same bits for any number of threads.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
};

}  // namespace softreel::sim
