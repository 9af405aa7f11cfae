#include "sim/multigrid_preconditioner.h"

#include <algorithm>

#include "sim/linear_input.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {
namespace {

// Up to so many rows of blocks a dense factorization costs less than a further level.
constexpr int kDirect = 64;

/// 3n x kModes: translations, turns. A turn is scaled by the size of its body, so that the unit of length does not
/// matter to what is taken for dependent.
Eigen::MatrixXd near_null_space(int rows, const LinearTargets& where) {
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(3 * rows, kModes);
  if (where.positions && !where.bodies.empty()) {
    const std::array<Eigen::VectorXd, 6> Z = rigid_modes(where);
    for (int m = 0; m < kModes; ++m) modes.col(m) = Z[static_cast<size_t>(m)];
    for (const BodyRange& body : where.bodies) {
      auto turns = modes.block(3 * body.first, 3, 3 * body.count, 3);
      const double size = body.count > 0 ? turns.cwiseAbs().maxCoeff() : 0.0;
      if (size > 0) turns /= size;
    }
    return modes;
  }
  for (int i = 0; i < 3 * rows; ++i)
    if (!where.held || !(*where.held)[static_cast<size_t>(i)]) modes(i, i % 3) = 1;
  return modes;
}

template <int B>
std::string factorize_dense(const BlockView<B>& A, Eigen::LLT<Eigen::MatrixXd>& factor) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(B * A.rows(), B * A.rows());
  for (int i = 0; i < A.rows(); ++i)
    for (int k = A.start[static_cast<size_t>(i)]; k < A.start[static_cast<size_t>(i) + 1]; ++k)
      dense.block<B, B>(B * i, B * A.column[static_cast<size_t>(k)]) =
          Eigen::Map<const Eigen::Matrix<double, B, B>>(A.values + size_t(B * B) * static_cast<size_t>(k));
  if (!dense.allFinite()) return "the matrix is not finite";
  factor.compute(dense);
  return factor.info() == Eigen::Success ? "" : kNotPositiveDefinite;
}

}  // namespace

void MultigridPreconditioner::build_levels(const BlockView<3>& A, const LinearTargets& where) {
  fine_rows_ = A.rows();
  coarser_.clear();
  direct_ = A.rows() <= kDirect;
  if (!direct_) {
    std::vector<std::uint8_t> held(where.held ? static_cast<size_t>(A.rows()) : 0);
    for (size_t i = 0; i < held.size(); ++i)
      held[i] = (*where.held)[3 * i] && (*where.held)[3 * i + 1] && (*where.held)[3 * i + 2];
    finest_.analyse(A, held);
    // An aggregate has two rows at least, so the levels end.
    for (const CoarseMatrix* matrix = &finest_.coarse(); matrix->view().rows() > kDirect;) {
      coarser_.emplace_back().analyse(matrix->view(), {});
      matrix = &coarser_.back().coarse();
    }
  }
  r_.resize(coarser_.size() + 1);
  z_.resize(coarser_.size() + 1);
  analysed_ = true;
}

std::string MultigridPreconditioner::factorize(const BlockMatrix& A, const LinearTargets& where) {
  const BlockView<3> view{A.row_start, A.column, A.values.data()};
  if (!analysed_) build_levels(view, where);
  if (direct_) return factorize_dense(view, coarsest_);
  Eigen::MatrixXd modes = near_null_space(A.rows(), where), coarse_modes;
  std::string failure = finest_.factorize(view, modes, coarse_modes);
  const CoarseMatrix* matrix = &finest_.coarse();
  for (MultigridLevel<kModes>& level : coarser_) {
    if (!failure.empty()) return failure;
    modes.swap(coarse_modes);
    failure = level.factorize(matrix->view(), modes, coarse_modes);
    matrix = &level.coarse();
  }
  return failure.empty() ? factorize_dense(matrix->view(), coarsest_) : failure;
}

void MultigridPreconditioner::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  if (direct_) {
    z = coarsest_.solve(r);
    return;
  }
  finest_.descend(r, z, r_[0]);
  cycle(0);
  finest_.ascend(r, z_[0], z);
}

/// z_[level] := a cycle for r_[level] on that coarser level.
void MultigridPreconditioner::cycle(size_t level) {
  if (level == coarser_.size()) {
    z_[level] = coarsest_.solve(r_[level]);
    return;
  }
  coarser_[level].descend(r_[level], z_[level], r_[level + 1]);
  cycle(level + 1);
  coarser_[level].ascend(r_[level], z_[level + 1], z_[level]);
}

std::size_t MultigridPreconditioner::bytes() const {
  size_t total = finest_.bytes() + sizeof(double) * static_cast<size_t>(coarsest_.rows() * coarsest_.rows());
  for (const auto& level : coarser_) total += level.bytes();
  for (const auto& v : r_) total += 2 * sizeof(double) * static_cast<size_t>(v.size());
  return total;
}

std::vector<int> MultigridPreconditioner::level_rows() const {
  std::vector<int> rows{fine_rows_};
  if (direct_) return rows;
  rows.push_back(finest_.coarse_rows());
  for (const auto& level : coarser_) rows.push_back(level.coarse_rows());
  return rows;
}

}  // namespace softreel::sim
