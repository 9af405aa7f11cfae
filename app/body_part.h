#pragma once
// Parts of bodies that a scene chooses by a box.
#include <string>
#include <vector>

#include "assets/scene.h"

namespace softreel::app {

/// Whether p lies in the box or on its faces.
bool contains(const assets::Box& box, const sim::Vec3& p);

/// Those that lie inside, in increasing order.
std::vector<int> vertices_in(const assets::Box& box, const std::vector<sim::Vec3>& vertices);

/// "reaches from (x, y, z) to (x, y, z) [m]": for whoever looked for a part where there is none.
std::string reach_text(const std::vector<sim::Vec3>& vertices);

}  // namespace softreel::app
