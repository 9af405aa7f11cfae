#pragma once
// Edges, boundary and hinges of triangle meshes.
#include <utility>
#include <vector>

#include "sim/mesh.h"

namespace softreel::sim {

/// Each edge once, (smaller, larger) vertex, in increasing order.
std::vector<std::pair<int, int>> edges(const TriangleMesh& mesh);

/// Vertices on the boundary (of an edge that belongs to exactly one triangle), in increasing order; none on a closed
/// surface.
std::vector<int> boundary_vertices(const TriangleMesh& mesh);

/// An inner edge with its two triangles. The edge runs from `a` to `b` in the left triangle (a, b, opposite_left) and
/// back in the right one (b, a, opposite_right).
struct Hinge {
  int a, b, opposite_left, opposite_right;
};

/// Every edge with exactly two triangles, in increasing order of edges.
std::vector<Hinge> hinges(const TriangleMesh& mesh);

}  // namespace softreel::sim
