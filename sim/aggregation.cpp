#include "sim/aggregation.h"

#include <algorithm>

namespace softreel::sim {

Aggregates aggregate(std::span<const int> start, std::span<const int> column, std::span<const std::uint8_t> left_out) {
  const int n = static_cast<int>(start.size()) - 1;
  Aggregates result;
  result.of_row.assign(static_cast<size_t>(n), -1);
  const auto takes_part = [&](int i) { return left_out.empty() || !left_out[static_cast<size_t>(i)]; };
  const auto neighbours = [&](int i) {
    return column.subspan(static_cast<size_t>(start[static_cast<size_t>(i)]),
                          static_cast<size_t>(start[static_cast<size_t>(i) + 1] - start[static_cast<size_t>(i)]));
  };
  for (int i = 0; i < n; ++i) {
    if (!takes_part(i)) continue;
    bool free = true, alone = true;
    for (int j : neighbours(i)) {
      free = free && result.of_row[static_cast<size_t>(j)] < 0;
      alone = alone && (j == i || !takes_part(j));
    }
    if (!free || alone) continue;
    for (int j : neighbours(i))
      if (takes_part(j)) result.of_row[static_cast<size_t>(j)] = result.count;
    result.of_row[static_cast<size_t>(i)] = result.count++;
  }
  // A row that is left over has a neighbour in an aggregate: that is why it did not begin one.
  const std::vector<int> first = result.of_row;
  std::vector<int> near;
  for (int i = 0; i < n; ++i) {
    if (first[static_cast<size_t>(i)] >= 0 || !takes_part(i)) continue;
    near.clear();
    for (int j : neighbours(i))
      if (first[static_cast<size_t>(j)] >= 0) near.push_back(first[static_cast<size_t>(j)]);
    std::sort(near.begin(), near.end());
    long most = 0;
    for (int a : near) {
      const long connections = std::count(near.begin(), near.end(), a);
      if (connections <= most) continue;
      most = connections;
      result.of_row[static_cast<size_t>(i)] = a;
    }
  }
  return result;
}

}  // namespace softreel::sim
