#pragma once
// One level of smoothed aggregation: its matrix, its smoother, and the way to the next coarser level.
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "sim/aggregation.h"

namespace softreel::sim {

inline constexpr int kModes = 6;  ///< unknowns of an aggregate: as many as a body has rigid motions

/// Sparse matrix of B x B blocks that belongs to somebody else: compressed rows, columns increasing, values
/// column-major.
template <int B>
struct BlockView {
  std::span<const int> start, column;
  const double* values = nullptr;
  int rows() const { return static_cast<int>(start.size()) - 1; }
};

/// The same, owned; made by the level above.
struct CoarseMatrix {
  std::vector<int> start, column;
  std::vector<double> values;  ///< kModes x kModes doubles per block
  BlockView<kModes> view() const { return {start, column, values.data()}; }
};

/// B: unknowns per row of blocks, 3 on the finest level, kModes on the others.
template <int B>
class MultigridLevel {
 public:
  /// Aggregates, and the patterns of the prolongation P and of P^T A P. `left_out`: flags of rows that no aggregate
  /// takes; may be empty.
  void analyse(const BlockView<B>& A, std::span<const std::uint8_t> left_out);

  /// P = (I - 4/(3 lambda) D^-1 A) T, lambda the largest eigenvalue of D^-1 A, D the diagonal blocks, and
  /// coarse() = P^T A P. T holds for every aggregate an orthonormal basis of `modes` (rows x kModes) on it, so that
  /// what A hardly sees is in the range of P; the next level's modes go to `coarse_modes`. Returns why not, or nothing.
  std::string factorize(const BlockView<B>& A, const Eigen::MatrixXd& modes, Eigen::MatrixXd& coarse_modes);

  /// z := one sweep of block Gauss-Seidel from 0 in increasing order; coarse_r := P^T (r - A z).
  void descend(const Eigen::VectorXd& r, Eigen::VectorXd& z, Eigen::VectorXd& coarse_r);
  /// z += P coarse_z, then a sweep in decreasing order: the adjoint of the first one, so that a cycle is symmetric.
  void ascend(const Eigen::VectorXd& r, const Eigen::VectorXd& coarse_z, Eigen::VectorXd& z) const;

  const CoarseMatrix& coarse() const { return coarse_; }
  int coarse_rows() const { return aggregates_.count; }
  std::size_t bytes() const;

 private:
  std::string invert_diagonal();
  double largest_eigenvalue() const;
  void make_tentative(const Eigen::MatrixXd& modes, Eigen::MatrixXd& coarse_modes);
  void smooth_prolongation();
  void multiply_out();

  BlockView<B> A_;
  Aggregates aggregates_;
  std::vector<int> members_start_, members_;       // rows of every aggregate
  std::vector<double> inverse_;                    // of the diagonal blocks, B x B
  std::vector<double> tentative_;                  // T, B x kModes per row
  std::vector<int> P_start_, P_column_;            // P by rows
  std::vector<double> P_;                          // B x kModes per block
  std::vector<int> PT_start_, PT_row_, PT_block_;  // for every column of P, its rows and blocks
  std::vector<int> AP_start_, AP_column_;          // A P by rows
  std::vector<double> AP_;
  CoarseMatrix coarse_;
  Eigen::VectorXd residual_;
};

extern template class MultigridLevel<3>;
extern template class MultigridLevel<kModes>;

}  // namespace softreel::sim
