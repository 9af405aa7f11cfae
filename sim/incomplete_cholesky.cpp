#include "sim/incomplete_cholesky.h"

#include <Eigen/Cholesky>

#include "sim/linear_input.h"

namespace softreel::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFirstShift = 1e-3;
constexpr double kLargestShift = 1e3;
// A pivot of less than so much of its diagonal entry would dominate the inverse.
constexpr double kSmallestPivot = 1e-4;

Eigen::Map<Matrix3d> block(std::vector<double>& values, int k) {
  return Eigen::Map<Matrix3d>(values.data() + 9 * static_cast<size_t>(k));
}

}  // namespace

void IncompleteCholesky::copy_pattern(const BlockMatrix& A) {
  start_.assign(1, 0);
  column_.clear();
  for (size_t i = 0; i < static_cast<size_t>(A.rows()); ++i) {
    column_.insert(column_.end(), A.column.begin() + A.row_start[i], A.column.begin() + A.diagonal[i]);
    start_.push_back(static_cast<int>(column_.size()));
  }
  lower_.resize(9 * column_.size());
  inverse_.resize(9 * static_cast<size_t>(A.rows()));
}

std::string IncompleteCholesky::factorize(const BlockMatrix& A, const LinearTargets&) {
  if (start_.empty()) copy_pattern(A);
  for (int i = 0; i < A.rows(); ++i) {
    const auto own = A.block(A.diagonal[static_cast<size_t>(i)]);
    if (own.allFinite() && own.llt().info() == Eigen::Success) continue;
    return own.allFinite() ? kNotPositiveDefinite : "the matrix is not finite";
  }
  for (shift_ = 0; shift_ <= kLargestShift; shift_ = shift_ > 0 ? 2 * shift_ : kFirstShift)
    if (factorize_shifted(A, shift_)) return {};
  return "the matrix is so far from diagonally dominant that no incomplete factor exists";
}

bool IncompleteCholesky::factorize_shifted(const BlockMatrix& A, double shift) {
  for (int i = 0; i < A.rows(); ++i) {
    const auto row = static_cast<size_t>(i);
    Matrix3d pivot = A.block(A.diagonal[row]);
    pivot.diagonal() *= 1 + shift;
    const Vector3d least = kSmallestPivot * pivot.diagonal();
    for (int k = start_[row]; k < start_[row + 1]; ++k) {
      const auto j = static_cast<size_t>(column_[static_cast<size_t>(k)]);
      // A_ij - sum over the blocks that rows i and j of L share
      Matrix3d rest = A.block(A.row_start[row] + (k - start_[row]));
      int a = start_[row], b = start_[j];
      while (a < k && b < start_[j + 1]) {
        const int ca = column_[static_cast<size_t>(a)], cb = column_[static_cast<size_t>(b)];
        if (ca == cb) rest.noalias() -= block(lower_, a) * block(lower_, b).transpose();
        a += ca <= cb;
        b += cb <= ca;
      }
      const Matrix3d L = rest * block(inverse_, static_cast<int>(j)).transpose();
      block(lower_, k) = L;
      pivot.noalias() -= L * L.transpose();
    }
    const Eigen::LLT<Matrix3d> factor(pivot);
    if (factor.info() != Eigen::Success) return false;
    const Matrix3d L = factor.matrixL();
    if (!(L.diagonal().array().square() > least.array()).all()) return false;
    block(inverse_, i) = L.triangularView<Eigen::Lower>().solve(Matrix3d::Identity());
  }
  return true;
}

void IncompleteCholesky::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  const int n = static_cast<int>(r.size()) / 3;
  z = r;
  for (int i = 0; i < n; ++i) {  // L y = r
    Vector3d y = z.segment<3>(3 * i);
    for (int k = start_[static_cast<size_t>(i)]; k < start_[static_cast<size_t>(i) + 1]; ++k)
      y.noalias() -= block(lower_, k) * z.segment<3>(3 * column_[static_cast<size_t>(k)]);
    z.segment<3>(3 * i).noalias() = block(inverse_, i) * y;
  }
  for (int i = n - 1; i >= 0; --i) {  // L^T z = y, by the columns of L^T
    const Vector3d own = block(inverse_, i).transpose() * z.segment<3>(3 * i);
    z.segment<3>(3 * i) = own;
    for (int k = start_[static_cast<size_t>(i)]; k < start_[static_cast<size_t>(i) + 1]; ++k)
      z.segment<3>(3 * column_[static_cast<size_t>(k)]).noalias() -= block(lower_, k).transpose() * own;
  }
}

std::size_t IncompleteCholesky::bytes() const {
  return sizeof(int) * (start_.size() + column_.size()) + sizeof(double) * (lower_.size() + inverse_.size());
}

}  // namespace softreel::sim
