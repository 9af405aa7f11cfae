#include "sim/mesh_topology.h"

#include <algorithm>
#include <tuple>

namespace softreel::sim {
namespace {

struct HalfEdge {
  int low, high;  // sorted ends
  int from, to;   // as the triangle runs
  int opposite;
  size_t order;
};

std::vector<HalfEdge> half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> all;
  all.reserve(mesh.triangles.size() * 3);
  for (const Triangle& t : mesh.triangles)
    for (size_t a = 0; a < 3; ++a) {
      const int p = t[a], q = t[(a + 1) % 3];
      all.push_back({std::min(p, q), std::max(p, q), p, q, t[(a + 2) % 3], all.size()});
    }
  std::sort(all.begin(), all.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.low, x.high, x.order) < std::tie(y.low, y.high, y.order);
  });
  return all;
}

bool same_edge(const HalfEdge& x, const HalfEdge& y) { return x.low == y.low && x.high == y.high; }

}  // namespace

std::vector<std::pair<int, int>> edges(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> result;
  for (const HalfEdge& e : half_edges(mesh))
    if (result.empty() || result.back() != std::pair(e.low, e.high)) result.emplace_back(e.low, e.high);
  return result;
}

std::vector<int> boundary_vertices(const TriangleMesh& mesh) {
  std::vector<int> result;
  const std::vector<HalfEdge> all = half_edges(mesh);
  for (size_t i = 0; i < all.size();) {
    size_t end = i + 1;
    while (end < all.size() && same_edge(all[i], all[end])) ++end;
    if (end == i + 1) result.insert(result.end(), {all[i].low, all[i].high});
    i = end;
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Hinge> hinges(const TriangleMesh& mesh) {
  std::vector<Hinge> result;
  const std::vector<HalfEdge> all = half_edges(mesh);
  for (size_t i = 0; i < all.size();) {
    size_t end = i + 1;
    while (end < all.size() && same_edge(all[i], all[end])) ++end;
    if (end == i + 2) result.push_back({all[i].from, all[i].to, all[i].opposite, all[i + 1].opposite});
    i = end;
  }
  return result;
}

}  // namespace softreel::sim
