#include "sim/multigrid_level.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "sim/linear_input.h"
#include "sim/parallel.h"

namespace softreel::sim {
namespace {

template <int R, int C>
Eigen::Map<const Eigen::Matrix<double, R, C>> block(const double* values, int k) {
  return Eigen::Map<const Eigen::Matrix<double, R, C>>(values + size_t(R * C) * static_cast<size_t>(k));
}
template <int R, int C>
Eigen::Map<Eigen::Matrix<double, R, C>> block(std::vector<double>& values, int k) {
  return Eigen::Map<Eigen::Matrix<double, R, C>>(values.data() + size_t(R * C) * static_cast<size_t>(k));
}

int at(std::span<const int> v, int i) { return v[static_cast<size_t>(i)]; }

/// Where row i of a pattern has `column`.
int find(const std::vector<int>& start, const std::vector<int>& columns, int i, int column) {
  const auto first = columns.begin() + at(start, i), last = columns.begin() + at(start, i + 1);
  return static_cast<int>(std::lower_bound(first, last, column) - columns.begin());
}

/// The columns of row after row, as `columns_of(i, out)` lists them, sorted, each once.
template <class ColumnsOf>
void make_pattern(int rows, const ColumnsOf& columns_of, std::vector<int>& start, std::vector<int>& column) {
  start.assign(1, 0);
  column.clear();
  std::vector<int> found;
  for (int i = 0; i < rows; ++i) {
    found.clear();
    columns_of(i, found);
    std::sort(found.begin(), found.end());
    column.insert(column.end(), found.begin(), std::unique(found.begin(), found.end()));
    start.push_back(static_cast<int>(column.size()));
  }
}

}  // namespace

template <int B>
void MultigridLevel<B>::analyse(const BlockView<B>& A, std::span<const std::uint8_t> left_out) {
  A_ = A;
  aggregates_ = aggregate(A.start, A.column, left_out);
  const int n = A.rows(), coarse = aggregates_.count;
  const auto of = [&](int i) { return at(aggregates_.of_row, i); };
  make_pattern(
      n,
      [&](int i, std::vector<int>& out) {
        for (int k = at(A.start, i); k < at(A.start, i + 1); ++k)
          if (const int a = of(at(A.column, k)); a >= 0) out.push_back(a);
      },
      P_start_, P_column_);
  make_pattern(
      n,
      [&](int i, std::vector<int>& out) {
        for (int k = at(A.start, i); k < at(A.start, i + 1); ++k) {
          const int j = at(A.column, k);
          out.insert(out.end(), P_column_.begin() + at(P_start_, j), P_column_.begin() + at(P_start_, j + 1));
        }
      },
      AP_start_, AP_column_);

  const auto list = [&](const std::vector<int>& key, std::vector<int>& start) {
    start.assign(static_cast<size_t>(coarse) + 1, 0);
    for (int a : key)
      if (a >= 0) ++start[static_cast<size_t>(a) + 1];
    for (size_t a = 1; a < start.size(); ++a) start[a] += start[a - 1];
  };
  list(aggregates_.of_row, members_start_);
  members_.resize(static_cast<size_t>(members_start_.back()));
  std::vector<int> next = members_start_;
  for (int i = 0; i < n; ++i)
    if (of(i) >= 0) members_[static_cast<size_t>(next[static_cast<size_t>(of(i))]++)] = i;
  list(P_column_, PT_start_);
  PT_row_.resize(P_column_.size());
  PT_block_.resize(P_column_.size());
  next = PT_start_;
  for (int i = 0; i < n; ++i)
    for (int k = at(P_start_, i); k < at(P_start_, i + 1); ++k) {
      const auto slot = static_cast<size_t>(next[static_cast<size_t>(at(P_column_, k))]++);
      PT_row_[slot] = i;
      PT_block_[slot] = k;
    }

  make_pattern(
      coarse,
      [&](int I, std::vector<int>& out) {
        for (int s = at(PT_start_, I); s < at(PT_start_, I + 1); ++s) {
          const int i = at(PT_row_, s);
          out.insert(out.end(), AP_column_.begin() + at(AP_start_, i), AP_column_.begin() + at(AP_start_, i + 1));
        }
      },
      coarse_.start, coarse_.column);
}

template <int B>
std::string MultigridLevel<B>::factorize(const BlockView<B>& A, const Eigen::MatrixXd& modes,
                                         Eigen::MatrixXd& coarse_modes) {
  A_ = A;
  if (std::string failure = invert_diagonal(); !failure.empty()) return failure;
  make_tentative(modes, coarse_modes);
  smooth_prolongation();
  multiply_out();
  residual_.resize(B * A.rows());
  return {};
}

template <int B>
std::string MultigridLevel<B>::invert_diagonal() {
  inverse_.resize(size_t(B * B) * static_cast<size_t>(A_.rows()));
  for (int i = 0; i < A_.rows(); ++i) {
    int own = at(A_.start, i);
    while (at(A_.column, own) != i) ++own;
    const Eigen::Matrix<double, B, B> D = block<B, B>(A_.values, own);
    const Eigen::LLT<Eigen::Matrix<double, B, B>> factor(D);
    if (!D.allFinite()) return "the matrix is not finite";
    if (factor.info() != Eigen::Success) return kNotPositiveDefinite;
    block<B, B>(inverse_, i) = factor.solve(Eigen::Matrix<double, B, B>::Identity());
  }
  return {};
}

/// Of D^-1 A, from below, by power iteration.
template <int B>
double MultigridLevel<B>::largest_eigenvalue() const {
  constexpr int kIterations = 10;
  const int n = A_.rows();
  Eigen::VectorXd v(B * n), Av(B * n);
  std::uint32_t bits = 1;  // the start only has to be rough, and the same each time
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    bits = 1664525u * bits + 1013904223u;
    v(i) = static_cast<double>(bits >> 8) / double(1 << 24) - 0.5;
  }
  double lambda = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    parallel_for(n, Work::kRow, [&](int i) {
      Eigen::Matrix<double, B, 1> sum = Eigen::Matrix<double, B, 1>::Zero();
      for (int k = at(A_.start, i); k < at(A_.start, i + 1); ++k)
        sum.noalias() += block<B, B>(A_.values, k) * v.template segment<B>(B * at(A_.column, k));
      Av.template segment<B>(B * i) = sum;
    });
    const double energy = dot(v, Av);
    parallel_for(n, Work::kRow, [&](int i) {
      v.template segment<B>(B * i).noalias() = block<B, B>(inverse_.data(), i) * Av.template segment<B>(B * i);
    });
    lambda = dot(v, Av) / energy;  // w^T D w / v^T A v with w = D^-1 A v
    v /= norm(v);
  }
  return lambda;
}

/// T and the coarse modes are the factors Q and R of the modes on every aggregate. Where they are dependent (a single
/// vertex has no turns), columns of T stay zero and belong to no unknown.
template <int B>
void MultigridLevel<B>::make_tentative(const Eigen::MatrixXd& modes, Eigen::MatrixXd& coarse_modes) {
  constexpr double kDependent = 1e-8;
  tentative_.assign(size_t(B * kModes) * static_cast<size_t>(A_.rows()), 0.0);
  coarse_modes.setZero(kModes * aggregates_.count, kModes);
  parallel_for(aggregates_.count, Work::kElement, [&](int a) {
    const int first = at(members_start_, a), count = at(members_start_, a + 1) - first;
    Eigen::MatrixXd here(B * count, kModes);
    for (int m = 0; m < count; ++m) here.middleRows<B>(B * m) = modes.middleRows<B>(B * at(members_, first + m));
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(here);
    qr.setThreshold(kDependent);
    const auto rank = qr.rank();
    Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(B * count, kModes);
    if (rank > 0) Q.leftCols(rank) = qr.householderQ() * Eigen::MatrixXd::Identity(B * count, rank);
    for (int m = 0; m < count; ++m) block<B, kModes>(tentative_, at(members_, first + m)) = Q.middleRows<B>(B * m);
    coarse_modes.middleRows<kModes>(kModes * a).noalias() = Q.transpose() * here;
  });
}

template <int B>
void MultigridLevel<B>::smooth_prolongation() {
  const double step = 4.0 / 3.0 / largest_eigenvalue();
  P_.assign(size_t(B * kModes) * P_column_.size(), 0.0);
  parallel_for(A_.rows(), Work::kElement, [&](int i) {
    for (int k = at(A_.start, i); k < at(A_.start, i + 1); ++k) {
      const int j = at(A_.column, k), a = at(aggregates_.of_row, j);
      if (a < 0) continue;
      block<B, kModes>(P_, find(P_start_, P_column_, i, a)).noalias() +=
          block<B, B>(A_.values, k) * block<B, kModes>(tentative_.data(), j);
    }
    const int own = at(aggregates_.of_row, i);
    for (int k = at(P_start_, i); k < at(P_start_, i + 1); ++k) {
      auto P = block<B, kModes>(P_, k);
      P = -step * (block<B, B>(inverse_.data(), i) * P).eval();
      if (at(P_column_, k) == own) P += block<B, kModes>(tentative_.data(), i);
    }
  });
}

template <int B>
void MultigridLevel<B>::multiply_out() {
  AP_.assign(size_t(B * kModes) * AP_column_.size(), 0.0);
  parallel_for(A_.rows(), Work::kElement, [&](int i) {
    for (int k = at(A_.start, i); k < at(A_.start, i + 1); ++k) {
      const int j = at(A_.column, k);
      for (int l = at(P_start_, j); l < at(P_start_, j + 1); ++l)
        block<B, kModes>(AP_, find(AP_start_, AP_column_, i, at(P_column_, l))).noalias() +=
            block<B, B>(A_.values, k) * block<B, kModes>(P_.data(), l);
    }
  });
  coarse_.values.assign(size_t(kModes * kModes) * coarse_.column.size(), 0.0);
  parallel_for(aggregates_.count, Work::kElement, [&](int I) {
    for (int s = at(PT_start_, I); s < at(PT_start_, I + 1); ++s) {
      const int i = at(PT_row_, s);
      const auto P = block<B, kModes>(P_.data(), at(PT_block_, s));
      for (int l = at(AP_start_, i); l < at(AP_start_, i + 1); ++l)
        block<kModes, kModes>(coarse_.values, find(coarse_.start, coarse_.column, I, at(AP_column_, l))).noalias() +=
            P.transpose() * block<B, kModes>(AP_.data(), l);
    }
    auto own = block<kModes, kModes>(coarse_.values, find(coarse_.start, coarse_.column, I, I));
    for (int m = 0; m < kModes; ++m)
      if (own(m, m) == 0) own(m, m) = 1;  // no unknown: an equation that gives 0
  });
}

template <int B>
void MultigridLevel<B>::descend(const Eigen::VectorXd& r, Eigen::VectorXd& z, Eigen::VectorXd& coarse_r) {
  using Vector = Eigen::Matrix<double, B, 1>;
  const int n = A_.rows();
  z.resize(B * n);
  for (int i = 0; i < n; ++i) {
    Vector sum = r.template segment<B>(B * i);
    for (int k = at(A_.start, i); at(A_.column, k) < i; ++k)
      sum.noalias() -= block<B, B>(A_.values, k) * z.template segment<B>(B * at(A_.column, k));
    z.template segment<B>(B * i).noalias() = block<B, B>(inverse_.data(), i) * sum;
  }
  // (D + L) z = r, so what is left is -U z.
  parallel_for(n, Work::kRow, [&](int i) {
    Vector sum = Vector::Zero();
    for (int k = at(A_.start, i + 1) - 1; at(A_.column, k) > i; --k)
      sum.noalias() -= block<B, B>(A_.values, k) * z.template segment<B>(B * at(A_.column, k));
    residual_.template segment<B>(B * i) = sum;
  });
  coarse_r.resize(kModes * aggregates_.count);
  parallel_for(aggregates_.count, Work::kElement, [&](int I) {
    Eigen::Matrix<double, kModes, 1> sum = Eigen::Matrix<double, kModes, 1>::Zero();
    for (int s = at(PT_start_, I); s < at(PT_start_, I + 1); ++s)
      sum.noalias() +=
          block<B, kModes>(P_.data(), at(PT_block_, s)).transpose() * residual_.template segment<B>(B * at(PT_row_, s));
    coarse_r.template segment<kModes>(kModes * I) = sum;
  });
}

template <int B>
void MultigridLevel<B>::ascend(const Eigen::VectorXd& r, const Eigen::VectorXd& coarse_z, Eigen::VectorXd& z) const {
  const int n = A_.rows();
  parallel_for(n, Work::kRow, [&](int i) {
    for (int k = at(P_start_, i); k < at(P_start_, i + 1); ++k)
      z.template segment<B>(B * i).noalias() +=
          block<B, kModes>(P_.data(), k) * coarse_z.template segment<kModes>(kModes * at(P_column_, k));
  });
  for (int i = n - 1; i >= 0; --i) {
    Eigen::Matrix<double, B, 1> sum = r.template segment<B>(B * i);
    for (int k = at(A_.start, i); k < at(A_.start, i + 1); ++k)
      if (at(A_.column, k) != i)
        sum.noalias() -= block<B, B>(A_.values, k) * z.template segment<B>(B * at(A_.column, k));
    z.template segment<B>(B * i).noalias() = block<B, B>(inverse_.data(), i) * sum;
  }
}

template <int B>
std::size_t MultigridLevel<B>::bytes() const {
  const auto ints = aggregates_.of_row.size() + members_start_.size() + members_.size() + P_start_.size() +
                    P_column_.size() + PT_start_.size() + PT_row_.size() + PT_block_.size() + AP_start_.size() +
                    AP_column_.size() + coarse_.start.size() + coarse_.column.size();
  const auto doubles = inverse_.size() + tentative_.size() + P_.size() + AP_.size() + coarse_.values.size() +
                       static_cast<size_t>(residual_.size());
  return sizeof(int) * ints + sizeof(double) * doubles;
}

template class MultigridLevel<3>;
template class MultigridLevel<kModes>;

}  // namespace softreel::sim
