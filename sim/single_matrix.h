#pragma once
// A block matrix' values once more in single precision, for products that wait for memory.
#include <Eigen/Core>
#include <vector>

#include "sim/block_matrix.h"

namespace softreel::sim {

/// Rounded to 24 bits, |A_single - A| <= 6e-8 |A| entry by entry.
class SingleMatrix {
 public:
  /// Takes the values; the pattern stays with `A`, which must outlive the products.
  void set(const BlockMatrix& A);
  bool empty() const { return !A_; }
  void clear() { A_ = nullptr; }

  /// Block rows [first, first + count) of y = A x.
  void multiply_rows(int first, int count, const Eigen::VectorXf& x, Eigen::VectorXf& y) const;

  std::size_t bytes() const { return sizeof(float) * values_.size(); }

 private:
  const BlockMatrix* A_ = nullptr;
  std::vector<float> values_;  // 9 per block, column-major; one more at the end
};

}  // namespace softreel::sim
