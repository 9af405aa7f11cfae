#pragma once
// How long the edges of a mesh are.
#include <algorithm>
#include <vector>

#include "sim/mesh.h"

namespace softreel::app {

struct Edges {
  double longest = 0, median = 0;  ///< [m]; 0 without elements
};

/// `elements`: corner indices of `vertices`; an edge counts once for each element that has it.
template <class Elements>
Edges edges_of(const std::vector<sim::Vec3>& vertices, const Elements& elements) {
  std::vector<double> lengths;
  Edges edges;
  for (const auto& element : elements)
    for (size_t a = 0; a < element.size(); ++a)
      for (size_t b = a + 1; b < element.size(); ++b)
        lengths.push_back(
            (vertices[static_cast<size_t>(element[a])] - vertices[static_cast<size_t>(element[b])]).norm());
  if (lengths.empty()) return edges;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  edges.median = *middle;
  edges.longest = *std::max_element(lengths.begin(), lengths.end());
  return edges;
}

}  // namespace softreel::app
