#include "sim/hessian_assembler.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

struct Contribution {
  int column;
  std::uint32_t slot;
};

}  // namespace

HessianAssembler::HessianAssembler(int vertices, std::span<const EnergyTerm* const> terms)
    : constant_scale_(terms.size(), 0.0) {
  // Contributions to upper blocks, sorted by (row, column, slot): rows by counting, the rest within each short row.
  const auto for_each_block = [&](const auto& visit) {
    std::uint32_t slot = 0;
    for (const EnergyTerm* term : terms) {
      const auto k = static_cast<size_t>(term->stencil_size());
      const auto stencils = term->stencils();
      for (size_t e = 0; k > 0 && e < stencils.size() / k; ++e)
        for (size_t a = 0; a < k; ++a)
          for (size_t b = a; b < k; ++b, ++slot) visit(stencils[e * k + a], stencils[e * k + b], slot);
    }
  };
  const auto n = static_cast<size_t>(vertices);
  std::vector<size_t> row_first(n + 1, 0);
  for_each_block([&](int i, int j, std::uint32_t) { ++row_first[static_cast<size_t>(std::min(i, j)) + 1]; });
  for (size_t i = 0; i < n; ++i) row_first[i + 1] += row_first[i];
  std::vector<Contribution> sorted(row_first[n]);
  std::vector<size_t> next(row_first.begin(), row_first.end() - 1);
  for_each_block([&](int i, int j, std::uint32_t slot) {
    sorted[next[static_cast<size_t>(std::min(i, j))]++] = {std::max(i, j), slot * 2 + (i > j ? 1U : 0U)};
  });

  std::vector<std::pair<int, int>> blocks;  // (row, column) of each upper block
  gather_.reserve(sorted.size());
  for (size_t i = 0; i < n; ++i) {
    const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(row_first[i]);
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(row_first[i + 1]);
    std::sort(begin, end, [](const Contribution& a, const Contribution& b) {
      return std::tie(a.column, a.slot) < std::tie(b.column, b.slot);
    });
    const int row = static_cast<int>(i);
    if (begin == end || begin->column != row) {  // a vertex without any stencil still has its mass
      blocks.emplace_back(row, row);
      gather_start_.push_back(gather_.size());
    }
    for (auto it = begin; it != end; ++it) {
      if (blocks.empty() || blocks.back() != std::pair(row, it->column)) {
        blocks.emplace_back(row, it->column);
        gather_start_.push_back(gather_.size());
      }
      gather_.push_back(it->slot);
    }
  }
  gather_start_.push_back(gather_.size());

  std::vector<int>& start = pattern_.row_start;
  start.assign(n + 1, 0);
  for (const auto& [i, j] : blocks) {
    ++start[static_cast<size_t>(i) + 1];
    if (i != j) ++start[static_cast<size_t>(j) + 1];
  }
  for (size_t i = 0; i < n; ++i) start[i + 1] += start[i];
  pattern_.column.resize(static_cast<size_t>(start[n]));
  pattern_.diagonal.resize(n);
  // Blocks come by increasing row, then column: filling a row's lower part first keeps its columns sorted.
  std::vector<int> fill(start.begin(), start.end() - 1);
  upper_.resize(blocks.size());
  mirror_.resize(blocks.size());
  for (size_t b = 0; b < blocks.size(); ++b) {
    const auto [i, j] = blocks[b];
    if (i == j) continue;
    mirror_[b] = fill[static_cast<size_t>(j)]++;
    pattern_.column[static_cast<size_t>(mirror_[b])] = i;
  }
  for (size_t b = 0; b < blocks.size(); ++b) {
    const auto [i, j] = blocks[b];
    upper_[b] = fill[static_cast<size_t>(i)]++;
    pattern_.column[static_cast<size_t>(upper_[b])] = j;
    upper_row_.push_back(i);
    if (i == j) pattern_.diagonal[static_cast<size_t>(i)] = mirror_[b] = upper_[b];
  }

  size_t doubles = 0;
  for (const EnergyTerm* term : terms) {
    term_slot_start_.push_back(doubles);
    const auto k = static_cast<size_t>(term->stencil_size());
    if (k > 0) doubles += term->stencils().size() / k * static_cast<size_t>(hessian_doubles(term->stencil_size()));
  }
  slots_.resize(doubles);
}

void HessianAssembler::assemble(std::span<const ScaledTerm> terms, const Eigen::VectorXd& masses,
                                const std::vector<std::uint8_t>& fixed, Definiteness definiteness,
                                BlockMatrix& matrix) {
  for (size_t t = 0; t < terms.size(); ++t) {
    const ScaledTerm& s = terms[t];
    if (s.term->stencil_size() == 0 || constant_scale_[t] == s.scale) continue;
    s.term->element_hessians(*s.at, s.scale, definiteness, slots_.data() + term_slot_start_[t]);
    ++evaluations_;
    if (s.term->constant_hessian()) constant_scale_[t] = s.scale;
  }
  if (matrix.column.size() != pattern_.column.size()) {
    matrix = pattern_;
    matrix.values.resize(pattern_.column.size() * 9);
  }
  parallel_for(static_cast<int>(upper_.size()), Work::kRow, [&](int b) {
    const auto k = static_cast<size_t>(b);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (size_t g = gather_start_[k]; g < gather_start_[k + 1]; ++g) {
      const Eigen::Map<const Eigen::Matrix3d> slot(slots_.data() + 9 * static_cast<size_t>(gather_[g] >> 1));
      if (gather_[g] & 1U)
        sum += slot.transpose();
      else
        sum += slot;
    }
    const int i = upper_row_[k], j = pattern_.column[static_cast<size_t>(upper_[k])];
    if (i == j && masses.size() > 0) sum.diagonal().array() += masses(i);
    const auto* row = &fixed[3 * static_cast<size_t>(i)];
    const auto* column = &fixed[3 * static_cast<size_t>(j)];
    for (int r = 0; r < 3; ++r) {
      if (row[r]) sum.row(r).setZero();
      if (column[r]) sum.col(r).setZero();
      if (i == j && row[r]) sum(r, r) = 1;
    }
    matrix.block(upper_[k]) = sum;
    if (i != j) matrix.block(mirror_[k]) = sum.transpose();
  });
}

}  // namespace softreel::sim
