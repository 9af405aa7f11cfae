#include "sim/changing_blocks.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

constexpr int kBatch = 64;      // stencils that a task computes
constexpr int kRowsATask = 64;  // of the matrix

/// Block (i, j) that a stencil gives, i or j -1: none.
template <class Visit>
void for_each_block(const EnergyTerm& term, StencilRange range, const Visit& visit) {
  const auto k = static_cast<size_t>(term.stencil_size());
  const auto stencils = term.stencils();
  size_t block = static_cast<size_t>(range.first) * k * (k + 1) / 2;
  for (auto e = static_cast<size_t>(range.first); e < static_cast<size_t>(range.first + range.count); ++e)
    for (size_t a = 0; a < k; ++a)
      for (size_t b = a; b < k; ++b, ++block)
        if (const int i = stencils[e * k + a], j = stencils[e * k + b]; i >= 0 && j >= 0) visit(i, j, block);
}

StencilRange all(const EnergyTerm& term) { return {0, stencil_count(term)}; }

/// Calls task(t, range) for all stencils of the terms that count, by batches of them.
template <class Task>
void for_batches(std::span<const ScaledTerm> terms, const Task& task) {
  std::vector<std::pair<size_t, StencilRange>> batches;
  for (size_t t = 0; t < terms.size(); ++t) {
    const int count = terms[t].scale == 0 ? 0 : stencil_count(*terms[t].term);
    for (int first = 0; first < count; first += kBatch)
      batches.push_back({t, {first, std::min(kBatch, count - first)}});
  }
  parallel_tasks(static_cast<int>(batches.size()), [&](int k) {
    const auto& [t, range] = batches[static_cast<size_t>(k)];
    task(static_cast<size_t>(k), t, range);
  });
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

/// Element Hessians of all terms, one after the other.
void ChangingBlocks::compute(std::span<const ScaledTerm> terms, Definiteness definiteness) {
  size_t doubles = 0;
  first_block_.clear();
  for (const ScaledTerm& s : terms) {
    first_block_.push_back(doubles / 9);
    if (s.scale == 0) continue;
    s.term->select(*s.at);
    doubles +=
        static_cast<size_t>(stencil_count(*s.term)) * static_cast<size_t>(hessian_doubles(s.term->stencil_size()));
  }
  blocks_.resize(doubles);
  for_batches(terms, [&](size_t, size_t t, StencilRange range) {
    const auto size = static_cast<size_t>(hessian_doubles(terms[t].term->stencil_size()));
    terms[t].term->element_hessians(*terms[t].at, terms[t].scale, definiteness, range,
                                    blocks_.data() + 9 * first_block_[t] + static_cast<size_t>(range.first) * size);
  });
}

/// Blocks (i, j), i < j, of the terms that `matrix` has no place for, sorted.
std::vector<ChangingBlocks::Place> ChangingBlocks::missing(const BlockMatrix& matrix,
                                                           std::span<const ScaledTerm> terms) {
  std::vector<std::vector<Place>> found;
  size_t batches = 0;
  for (const ScaledTerm& s : terms) batches += static_cast<size_t>((stencil_count(*s.term) + kBatch - 1) / kBatch);
  found.resize(batches);
  for_batches(terms, [&](size_t batch, size_t t, StencilRange range) {
    for_each_block(*terms[t].term, range, [&](int i, int j, size_t) {
      if (i != j && matrix.find(i, j) < 0) found[batch].push_back({std::min(i, j), std::max(i, j)});
    });
  });
  std::vector<Place> result;
  for (const auto& part : found) result.insert(result.end(), part.begin(), part.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The blocks that each row gets, in the order of terms and stencils.
void ChangingBlocks::sort_by_row(std::span<const ScaledTerm> terms, size_t rows) {
  row_first_.assign(rows + 1, 0);
  const auto each = [&](const auto& visit) {
    for (size_t t = 0; t < terms.size(); ++t)
      if (terms[t].scale != 0)
        for_each_block(*terms[t].term, all(*terms[t].term), [&](int i, int j, size_t block) {
          const auto number = static_cast<int>(first_block_[t] + block);
          visit(i, Share{j, number, false});
          if (i != j) visit(j, Share{i, number, true});
        });
  };
  each([&](int row, const Share&) { ++row_first_[static_cast<size_t>(row) + 1]; });
  for (size_t i = 0; i < rows; ++i) row_first_[i + 1] += row_first_[i];
  shares_.resize(static_cast<size_t>(row_first_[rows]));
  std::vector<int> next(row_first_.begin(), row_first_.end() - 1);
  each([&](int row, const Share& share) { shares_[static_cast<size_t>(next[static_cast<size_t>(row)]++)] = share; });
}

/// One row of H: what `fixed` has there, and its shares.
void ChangingBlocks::fill_row(const BlockMatrix& fixed, const std::vector<std::uint8_t>& held, int row,
                              BlockMatrix& H) const {
  const auto i = static_cast<size_t>(row);
  for (int k = H.row_start[i], of_fixed = fixed.row_start[i]; k < H.row_start[i + 1]; ++k) {
    if (of_fixed < fixed.row_start[i + 1] && from_[static_cast<size_t>(of_fixed)] == k)
      H.block(k) = fixed.block(of_fixed++);
    else
      H.block(k).setZero();
  }
  for (int n = row_first_[i]; n < row_first_[i + 1]; ++n) {
    const Share& share = shares_[static_cast<size_t>(n)];
    Eigen::Matrix3d B = Eigen::Map<const Eigen::Matrix3d>(blocks_.data() + 9 * static_cast<size_t>(share.block));
    if (share.transposed) B.transposeInPlace();
    for (int r = 0; r < 3; ++r) {
      if (held[3 * i + static_cast<size_t>(r)]) B.row(r).setZero();
      if (held[3 * static_cast<size_t>(share.column) + static_cast<size_t>(r)]) B.col(r).setZero();
    }
    H.block(share.column == row ? H.diagonal[i] : H.find(row, share.column)) += B;
  }
}

void ChangingBlocks::add(const BlockMatrix& fixed, std::span<const ScaledTerm> terms,
                         const std::vector<std::uint8_t>& held, Definiteness definiteness, BlockMatrix& H) {
  compute(terms, definiteness);
  const bool other = fixed_blocks_ != static_cast<long>(fixed.column.size());
  const bool anew = fresh_ || other;
  std::vector<Place> needed = missing(anew ? fixed : pattern_, terms);
  fresh_ = false;
  if (!anew && !needed.empty()) {
    std::vector<Place> both;
    std::set_union(extra_.begin(), extra_.end(), needed.begin(), needed.end(), std::back_inserter(both));
    needed = std::move(both);
  }
  if (other || (anew ? needed != extra_ : !needed.empty())) {
    extra_ = std::move(needed);
    lay_out(fixed);
  }
  if (H.pattern != pattern_.pattern || H.column.size() != pattern_.column.size()) {
    H = pattern_;
    H.values.resize(pattern_.column.size() * 9 + 1);
  }
  const int rows = fixed.rows();
  sort_by_row(terms, static_cast<size_t>(rows));
  parallel_tasks((rows + kRowsATask - 1) / kRowsATask, [&](int task) {
    for (int row = task * kRowsATask; row < std::min(rows, (task + 1) * kRowsATask); ++row)
      fill_row(fixed, held, row, H);
  });
}

}  // namespace softreel::sim
