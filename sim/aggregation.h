#pragma once
// Groups of neighbouring vertices, the unknowns of the next coarser level of algebraic multigrid.
#include <cstdint>
#include <span>
#include <vector>

namespace softreel::sim {

struct Aggregates {
  std::vector<int> of_row;  ///< per row its aggregate; -1: in none
  int count = 0;
};

/// Disjoint neighbourhoods in the graph of a sparse matrix (`start`, `column`: compressed rows), in the order of the
/// rows; what is left over joins the aggregate that it has most connections with (Vanek, Mandel, Brezina 1996, section
/// 5.1, with every connection taken as strong: so the aggregates depend on the pattern alone, and stay as long as it).
/// Rows that are `left_out` (flags; empty: none) or have no neighbours are in no aggregate.
Aggregates aggregate(std::span<const int> start, std::span<const int> column, std::span<const std::uint8_t> left_out);

}  // namespace softreel::sim
