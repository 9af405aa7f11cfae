#pragma once
#include "assets/scene.h"

namespace softreel::assets {

/// Is there contact between surfaces in the scene? Two bodies can meet, and a body and a mesh collider; a body meets
/// itself where it is asked for.
bool has_touching_surfaces(const Scene& scene);

}  // namespace softreel::assets
