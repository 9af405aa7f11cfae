#pragma once
// Surfaces that lie wholly inside a solid: nothing crosses there, and still two bodies are in one place.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/contact/contact_surfaces.h"

namespace softreel::app {

/// Pairs (solid, surface inside it) among those that can touch. `x`: of all vertices [m], such that nothing crosses
/// between the two of such a pair; `solid`: per surface, whether there is a body inside it. A surface of several parts
/// is inside if one of them is. Closed cloths and mesh colliders are no solids: they may hold what is in them.
std::vector<std::pair<int, int>> enclosed(const sim::ContactSurfaces& surfaces, std::span<const sim::Vec3> x,
                                          std::span<const std::uint8_t> solid);

}  // namespace softreel::app
