#pragma once
// How to move one body clear of another.
#include <span>
#include <vector>

#include "sim/mesh.h"

namespace softreel::app {

/// The shortest way [m] along an axis or one of `directions`, either way round, that takes the points `own` so far from
/// the points `other` that a plane across it has `gap` [m] between the two. Of faces' normals the one that makes it
/// least is, for boxes that meet face first, the least translation there is (separating axes: Gottschalk, Lin, Manocha
/// 1996, "OBBTree", section 5). Upwards among equals: what lies below is often the ground. Zero if they are apart.
sim::Vec3 way_apart(std::span<const sim::Vec3> own, std::span<const sim::Vec3> other,
                    std::span<const sim::Vec3> directions, double gap);

}  // namespace softreel::app
