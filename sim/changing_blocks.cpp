#include "sim/changing_blocks.h"

#include <algorithm>
#include <iterator>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

constexpr int kBatch = 64;  // stencils that a task computes

/// Position of block (row, column), or -1.
int find(const BlockMatrix& A, int row, int column) {
  const auto begin = A.column.begin() + A.row_start[static_cast<size_t>(row)];
  const auto end = A.column.begin() + A.row_start[static_cast<size_t>(row) + 1];
  const auto it = std::lower_bound(begin, end, column);
  return it != end && *it == column ? static_cast<int>(it - A.column.begin()) : -1;
}

}  // namespace

/// pattern_ := that of `fixed` and extra_.
void ChangingBlocks::lay_out(const BlockMatrix& fixed) {
  std::vector<Place> both;  // and their transposes
  both.reserve(2 * extra_.size());
  for (const Place& p : extra_) both.push_back(p), both.push_back({p.column, p.row});
  std::sort(both.begin(), both.end());
  const auto rows = static_cast<size_t>(fixed.rows());
  pattern_.row_start.assign(rows + 1, 0);
  pattern_.column.clear();
  pattern_.column.reserve(fixed.column.size() + both.size());
  pattern_.diagonal.resize(rows);
  from_.resize(fixed.column.size());
  size_t next = 0;
  for (size_t i = 0; i < rows; ++i) {
    int k = fixed.row_start[i];
    const int last = fixed.row_start[i + 1];
    while (k < last || (next < both.size() && both[next].row == static_cast<int>(i))) {
      const bool take_extra = next < both.size() && both[next].row == static_cast<int>(i) &&
                              (k == last || both[next].column < fixed.column[static_cast<size_t>(k)]);
      if (take_extra) {
        pattern_.column.push_back(both[next++].column);
        continue;
      }
      const auto place = static_cast<int>(pattern_.column.size());
      if (fixed.column[static_cast<size_t>(k)] == static_cast<int>(i)) pattern_.diagonal[i] = place;
      from_[static_cast<size_t>(k)] = place;
      pattern_.column.push_back(fixed.column[static_cast<size_t>(k++)]);
    }
    pattern_.row_start[i + 1] = static_cast<int>(pattern_.column.size());
  }
  pattern_.pattern = ++patterns_;
  fixed_blocks_ = static_cast<long>(fixed.column.size());
}

void ChangingBlocks::add(const BlockMatrix& fixed, std::span<const ScaledTerm> terms,
                         const std::vector<std::uint8_t>& held, Definiteness definiteness, BlockMatrix& H) {
  // Element Hessians, and where they go.
  size_t doubles = 0;
  std::vector<size_t> start;
  for (const ScaledTerm& s : terms) {
    start.push_back(doubles);
    if (s.scale == 0) continue;
    s.term->select(*s.at);
    doubles +=
        static_cast<size_t>(stencil_count(*s.term)) * static_cast<size_t>(hessian_doubles(s.term->stencil_size()));
  }
  blocks_.resize(doubles);
  std::vector<Place> needed;
  const auto for_each_block = [&](const ScaledTerm& s, const auto& visit) {
    const auto k = static_cast<size_t>(s.term->stencil_size());
    const auto stencils = s.term->stencils();
    size_t block = 0;
    for (size_t e = 0; e < stencils.size() / k; ++e)
      for (size_t a = 0; a < k; ++a)
        for (size_t b = a; b < k; ++b, ++block)
          if (const int i = stencils[e * k + a], j = stencils[e * k + b]; i >= 0 && j >= 0) visit(i, j, block);
  };
  for (size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].scale == 0) continue;
    const ScaledTerm& s = terms[t];
    const int count = stencil_count(*s.term), size = hessian_doubles(s.term->stencil_size());
    parallel_tasks((count + kBatch - 1) / kBatch, [&](int task) {
      const StencilRange range{task * kBatch, std::min(kBatch, count - task * kBatch)};
      s.term->element_hessians(
          *s.at, s.scale, definiteness, range,
          blocks_.data() + start[t] + static_cast<size_t>(range.first) * static_cast<size_t>(size));
    });
    for_each_block(s, [&](int i, int j, size_t) {
      if (i != j && find(fixed, i, j) < 0) needed.push_back({std::min(i, j), std::max(i, j)});
    });
  }
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  const bool other = fixed_blocks_ != static_cast<long>(fixed.column.size());
  if (!fresh_ && !other) {
    std::vector<Place> all;
    std::set_union(extra_.begin(), extra_.end(), needed.begin(), needed.end(), std::back_inserter(all));
    needed = std::move(all);
  }
  fresh_ = false;
  if (other || needed != extra_) {
    extra_ = std::move(needed);
    lay_out(fixed);
  }
  if (H.pattern != pattern_.pattern || H.column.size() != pattern_.column.size()) {
    H = pattern_;
    H.values.resize(pattern_.column.size() * 9 + 1);
  }
  std::fill(H.values.begin(), H.values.end(), 0.0);
  parallel_for(static_cast<int>(from_.size()), Work::kVector,
               [&](int k) { H.block(from_[static_cast<size_t>(k)]) = fixed.block(k); });
  for (size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].scale == 0) continue;
    for_each_block(terms[t], [&](int i, int j, size_t block) {
      Eigen::Matrix3d B = Eigen::Map<const Eigen::Matrix3d>(blocks_.data() + start[t] + 9 * block);
      for (int r = 0; r < 3; ++r) {
        if (held[3 * static_cast<size_t>(i) + static_cast<size_t>(r)]) B.row(r).setZero();
        if (held[3 * static_cast<size_t>(j) + static_cast<size_t>(r)]) B.col(r).setZero();
      }
      if (i == j) {
        H.block(H.diagonal[static_cast<size_t>(i)]) += B;
        return;
      }
      H.block(find(H, i, j)) += B;
      H.block(find(H, j, i)) += B.transpose();
    });
  }
}

}  // namespace softreel::sim
