#include "sim/block_matrix.h"

#include "sim/parallel.h"

namespace softreel::sim {

void BlockMatrix::multiply_rows(int first, int count, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  for (int i = first; i < first + count; ++i) {
    double s0 = 0, s1 = 0, s2 = 0;
    const double* a = values.data() + 9 * static_cast<size_t>(row_start[static_cast<size_t>(i)]);
    const int end = row_start[static_cast<size_t>(i) + 1];
    for (int k = row_start[static_cast<size_t>(i)]; k < end; ++k, a += 9) {
      const double* p = x.data() + 3 * static_cast<size_t>(column[static_cast<size_t>(k)]);
      s0 += a[0] * p[0] + a[3] * p[1] + a[6] * p[2];
      s1 += a[1] * p[0] + a[4] * p[1] + a[7] * p[2];
      s2 += a[2] * p[0] + a[5] * p[1] + a[8] * p[2];
    }
    y(3 * i) = s0;
    y(3 * i + 1) = s1;
    y(3 * i + 2) = s2;
  }
}

void BlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(3 * rows());
  parallel_for(rows(), Work::kRow, [&](int i) { multiply_rows(i, 1, x, y); });
}

}  // namespace softreel::sim
