#pragma once
// Adds terms whose stencils change to a matrix whose pattern does not know them.
#include <span>
#include <vector>

#include "sim/hessian_assembler.h"

namespace softreel::sim {

/// The pattern is that of the first call after `begin`, and grows by what later calls need beyond it. So it stays the
/// same over most of the matrices of a solve, and does not depend on what was before.
class ChangingBlocks {
 public:
  /// A new solve.
  void begin() { fresh_ = true; }

  /// H := fixed + sum scale * Hessian of the `terms` where they are (`select` is called); rows and columns of `held`
  /// degrees of freedom (3n flags) get nothing. The same bits for any number of threads.
  void add(const BlockMatrix& fixed, std::span<const ScaledTerm> terms, const std::vector<std::uint8_t>& held,
           Definiteness definiteness, BlockMatrix& H);

 private:
  struct Place {
    int row, column;
    auto operator<=>(const Place&) const = default;
  };
  /// What a row of the matrix gets: block `block` of blocks_, or its transpose.
  struct Share {
    int column, block;
    bool transposed;
  };
  void compute(std::span<const ScaledTerm> terms, Definiteness definiteness);
  static std::vector<Place> missing(const BlockMatrix& matrix, std::span<const ScaledTerm> terms);
  void lay_out(const BlockMatrix& fixed);
  void sort_by_row(std::span<const ScaledTerm> terms, size_t rows);
  void fill_row(const BlockMatrix& fixed, const std::vector<std::uint8_t>& held, int row, BlockMatrix& H) const;

  BlockMatrix pattern_;       // without values
  std::vector<int> from_;     // of each block of the fixed matrix: where it is in pattern_
  std::vector<Place> extra_;  // blocks (i, j), i < j, beyond those of the fixed matrix, sorted
  long fixed_blocks_ = -1;    // of the matrix that pattern_ was made for
  bool fresh_ = true;
  long patterns_ = 0;
  std::vector<double> blocks_;       // of all stencils, 9 doubles each
  std::vector<size_t> first_block_;  // of each term in it
  std::vector<int> row_first_;       // rows + 1 offsets into shares_
  std::vector<Share> shares_;
};

}  // namespace softreel::sim
