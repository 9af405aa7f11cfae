#pragma once
// Meshes without vertices that no element uses.
#include <cstddef>
#include <vector>

#include "sim/mesh.h"

namespace softreel::assets {

/// Renumbers `vertices` so that only those that `elements` (triangles or tets) name are left, in their order. Returns
/// the new number of each old vertex, -1 for one that was dropped.
template <class Element>
std::vector<int> drop_unused(std::vector<sim::Vec3>& vertices, std::vector<Element>& elements) {
  std::vector<int> number(vertices.size(), -1);
  for (const Element& e : elements) {
    for (const int v : e) number[static_cast<std::size_t>(v)] = 0;
  }
  int count = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    vertices[static_cast<std::size_t>(count)] = vertices[i];
    number[i] = count++;
  }
  vertices.resize(static_cast<std::size_t>(count));
  for (Element& e : elements) {
    for (int& v : e) v = number[static_cast<std::size_t>(v)];
  }
  return number;
}

}  // namespace softreel::assets
