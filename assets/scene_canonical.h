#pragma once
// What decides whether a simulation or a picture is up to date, as text to be hashed.
#include <string>

#include "assets/scene.h"

namespace softreel::assets {

/// Every key that the simulation depends on, one "key = value" a line, numbers exact. The duration is not among them:
/// a longer clip goes on from the frames that are there. Contents of assets are not in it: hash the files of
/// `scene.assets` with `physics` beside it.
std::string canonical_physics(const Scene& scene);

/// Every key that only the picture depends on. When something is placed by what the whole clip covers (camera, ground,
/// area lights, the range of a field), the duration is among them.
std::string canonical_picture(const Scene& scene);

}  // namespace softreel::assets
