#include "sim/hessian_assembler.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

// Parts have some hundred stencils at least; so many that threads share them evenly.
constexpr int kStencilsPerPart = 256, kMostParts = 64;
// Stencils whose Hessians are computed, then added: they stay in the nearest cache.
constexpr int kBatch = 32;

struct Contribution {
  int column;
  int part;
  std::uint32_t* target;
  bool transposed;
};

/// Stencils [first, last) of a term that belong to a part.
std::pair<int, int> share_of(int part, int parts, int stencils) {
  const auto bound = [&](int p) { return static_cast<int>(static_cast<long>(stencils) * p / parts); };
  return {bound(part), bound(part + 1)};
}

}  // namespace

/// Where a block of a stencil goes: position of a block in the matrix, or in `shared`; whether it is the first one
/// there (it then replaces what was), and is to be transposed.
struct HessianAssembler::Target {
  static constexpr std::uint32_t kTransposed = 1, kFirst = 2, kShared = 4;
  static constexpr int kFlags = 3;
};

HessianAssembler::HessianAssembler(int vertices, std::span<const EnergyTerm* const> terms) : plans_(terms.size()) {
  long stencils = 0;
  for (const EnergyTerm* term : terms) stencils += stencil_count(*term);
  parts_ = static_cast<int>(std::clamp(stencils / kStencilsPerPart, 1L, static_cast<long>(kMostParts)));

  // Contributions to upper blocks: rows by counting, then sorted within each short row by column, part, and the order
  // in which the part adds them.
  const auto for_each_block = [&](const auto& visit) {
    for (size_t t = 0; t < terms.size(); ++t) {
      const auto k = static_cast<size_t>(terms[t]->stencil_size());
      const auto vertex = terms[t]->stencils();
      std::uint32_t* target = plans_[t].targets.data();
      for (int part = 0; k > 0 && part < parts_; ++part) {
        const auto [first, last] = share_of(part, parts_, stencil_count(*terms[t]));
        for (size_t e = static_cast<size_t>(first); e < static_cast<size_t>(last); ++e)
          for (size_t a = 0; a < k; ++a)
            for (size_t b = a; b < k; ++b, ++target) visit(vertex[e * k + a], vertex[e * k + b], part, target);
      }
    }
  };
  for (size_t t = 0; t < terms.size(); ++t)
    plans_[t].targets.resize(static_cast<size_t>(stencil_count(*terms[t])) *
                             static_cast<size_t>(hessian_doubles(terms[t]->stencil_size()) / 9));
  const auto n = static_cast<size_t>(vertices);
  std::vector<size_t> row_first(n + 1, 0);
  for_each_block([&](int i, int j, int, std::uint32_t*) { ++row_first[static_cast<size_t>(std::min(i, j)) + 1]; });
  for (size_t i = 0; i < n; ++i) row_first[i + 1] += row_first[i];
  std::vector<Contribution> sorted(row_first[n]);
  std::vector<size_t> next(row_first.begin(), row_first.end() - 1);
  for_each_block([&](int i, int j, int part, std::uint32_t* target) {
    sorted[next[static_cast<size_t>(std::min(i, j))]++] = {std::max(i, j), part, target, i > j};
  });

  std::vector<std::pair<int, int>> blocks;  // (row, column) of each upper block
  std::vector<size_t> block_first;          // its contributions
  for (size_t i = 0; i < n; ++i) {
    const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(row_first[i]);
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(row_first[i + 1]);
    std::stable_sort(begin, end, [](const Contribution& a, const Contribution& b) {
      return std::tie(a.column, a.part) < std::tie(b.column, b.part);
    });
    const int row = static_cast<int>(i);
    if (begin == end || begin->column != row) {  // a vertex without any stencil still has its mass
      blocks.emplace_back(row, row);
      block_first.push_back(static_cast<size_t>(begin - sorted.begin()));
    }
    for (auto it = begin; it != end; ++it) {
      if (!blocks.empty() && blocks.back() == std::pair(row, it->column)) continue;
      blocks.emplace_back(row, it->column);
      block_first.push_back(static_cast<size_t>(it - sorted.begin()));
    }
  }
  block_first.push_back(sorted.size());
  lay_out(n, blocks);

  size_t shares = 0;
  for (size_t b = 0; b < blocks.size(); ++b) {
    const std::span<const Contribution> own(sorted.data() + block_first[b], block_first[b + 1] - block_first[b]);
    empty_.push_back(own.empty());
    share_start_.push_back(shares);
    const bool shared = !own.empty() && own.front().part != own.back().part;
    for (size_t c = 0; c < own.size(); ++c) {
      const bool first = c == 0 || (shared && own[c].part != own[c - 1].part);
      if (shared && first) ++shares;
      const auto place = static_cast<std::uint32_t>(shared ? shares - 1 : static_cast<size_t>(upper_[b]));
      *own[c].target = place << Target::kFlags | (shared ? Target::kShared : 0) | (first ? Target::kFirst : 0) |
                       (own[c].transposed ? Target::kTransposed : 0);
    }
  }
  share_start_.push_back(shares);
  shared_.resize(9 * shares);
}

/// Places of the blocks and of their transposes in the rows of the matrix.
void HessianAssembler::lay_out(size_t n, std::span<const std::pair<int, int>> blocks) {
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
}

void HessianAssembler::add(const double* blocks, std::span<const std::uint32_t> targets, double* matrix,
                           double* shared) {
  for (const std::uint32_t target : targets) {
    const Eigen::Map<const Eigen::Matrix3d> block(blocks);
    blocks += 9;
    double* place = (target & Target::kShared ? shared : matrix) + 9 * static_cast<size_t>(target >> Target::kFlags);
    Eigen::Map<Eigen::Matrix3d> sum(place);
    if (target & Target::kFirst) {
      if (target & Target::kTransposed)
        sum = block.transpose();
      else
        sum = block;
    } else if (target & Target::kTransposed) {
      sum += block.transpose();
    } else {
      sum += block;
    }
  }
}

void HessianAssembler::add_part(int part, std::span<const ScaledTerm> terms, Definiteness definiteness,
                                BlockMatrix& matrix) {
  using Batch = std::array<double, static_cast<size_t>(kBatch * hessian_doubles(kMostVertices))>;
  // A term that counts for nothing, as damping in an equilibrium, is not asked: it may have no velocities to go by.
  static constexpr Batch kNothing{};
  Batch batch;
  for (size_t t = 0; t < terms.size(); ++t) {
    const ScaledTerm& s = terms[t];
    const auto doubles = static_cast<size_t>(hessian_doubles(s.term->stencil_size()));
    if (doubles == 0) continue;
    const TermPlan& plan = plans_[t];
    const auto [first, last] = share_of(part, parts_, stencil_count(*s.term));
    for (int e = first; e < last; e += kBatch) {
      const StencilRange range{e, std::min(kBatch, last - e)};
      const double* blocks = batch.data();
      if (s.scale == 0)
        blocks = kNothing.data();
      else if (s.term->constant_hessian())
        blocks = plan.constant.data() + doubles * static_cast<size_t>(e);
      else
        s.term->element_hessians(*s.at, s.scale, definiteness, range, batch.data());
      add(blocks,
          std::span(plan.targets)
              .subspan(doubles / 9 * static_cast<size_t>(e), doubles / 9 * static_cast<size_t>(range.count)),
          matrix.values.data(), shared_.data());
    }
  }
}

void HessianAssembler::assemble(std::span<const ScaledTerm> terms, const Eigen::VectorXd& masses,
                                const std::vector<std::uint8_t>& fixed, Definiteness definiteness,
                                BlockMatrix& matrix) {
  for (size_t t = 0; t < terms.size(); ++t) {
    const ScaledTerm& s = terms[t];
    TermPlan& plan = plans_[t];
    if (plan.targets.empty() || s.scale == 0) continue;
    const bool constant = s.term->constant_hessian();
    if (constant && plan.constant_scale == s.scale) continue;
    ++evaluations_;
    if (!constant) continue;
    plan.constant.resize(9 * plan.targets.size());
    all_element_hessians(*s.term, *s.at, s.scale, definiteness, plan.constant.data());
    plan.constant_scale = s.scale;
  }
  if (matrix.column.size() != pattern_.column.size()) {
    matrix = pattern_;
    matrix.values.resize(pattern_.column.size() * 9 + 1);
  }
  parallel_tasks(parts_, [&](int part) { add_part(part, terms, definiteness, matrix); });
  parallel_for(static_cast<int>(upper_.size()), Work::kRow, [&](int b) {
    const auto k = static_cast<size_t>(b);
    Eigen::Map<Eigen::Matrix3d> sum = matrix.block(upper_[k]);
    if (empty_[k]) sum.setZero();
    for (size_t share = share_start_[k]; share < share_start_[k + 1]; ++share) {
      const Eigen::Map<const Eigen::Matrix3d> part(shared_.data() + 9 * share);
      if (share == share_start_[k])
        sum = part;
      else
        sum += part;
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
    if (i != j) matrix.block(mirror_[k]) = sum.transpose();
  });
}

}  // namespace softreel::sim
