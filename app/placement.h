#pragma once
// Where the scene file puts a mesh: scale, rotate, translate about its pivot.
#include <vector>

#include "assets/scene.h"
#include "sim/mesh.h"

namespace softreel::app {

/// p -> scale * (p - pivot), in place: what changes the rest shape, and so what the tetrahedralizer gets.
void scale_about_pivot(const assets::Transform& transform, std::vector<sim::Vec3>& vertices);

/// p -> R p + pivot + translate, in place, on what scale_about_pivot gave: a rigid placement.
void place(const assets::Transform& transform, std::vector<sim::Vec3>& vertices);

/// Both on one point.
sim::Vec3 placed(const assets::Transform& transform, const sim::Vec3& point);

}  // namespace softreel::app
