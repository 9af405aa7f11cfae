#pragma once
// All pairs of faces of one surface that cross.
#include <functional>
#include <utility>
#include <vector>

#include "sim/mesh.h"

namespace softreel::assets {

/// Pairs (i < j) of triangles that meet beyond what they share (see triangles_cross), sorted; at most `limit` of them.
/// Flat triangles and faces with the same three vertices are left out. A tree of boxes finds the candidates.
/// `wanted`, if given, says of two triangles whether they are looked at: what is not asked for costs a test of boxes.
/// Several threads call it at once.
std::vector<std::pair<int, int>> crossing_pairs(const sim::TriangleMesh& mesh, std::size_t limit,
                                                const std::function<bool(int, int)>& wanted = {});

}  // namespace softreel::assets
