#pragma once
#include "assets/scene.h"

namespace softreel::assets {

/// Is there contact between surfaces in the scene? Two bodies can meet, and a body and a mesh collider; a body meets
/// itself where it is asked for.
bool has_touching_surfaces(const Scene& scene);

/// Below which bodies of the scene fall asleep [m/s]; 0: none ever does, since nothing can touch, equilibria are looked
/// for, or errors in time are estimated (which are smaller than what sleep gives up).
double sleep_speed(const Scene& scene);

}  // namespace softreel::assets
