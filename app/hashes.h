#pragma once
// Two hashes decide what is up to date.
#include <string>

#include "assets/scene.h"

namespace softreel::app {

/// Over the physics keys and the contents of the files that the simulation reads. Throws UserError (kInput).
std::string simulation_hash(const assets::Scene& scene);

/// Over that, the picture keys, the contents of the files that only the picture reads, and the clip's length where
/// camera, ground or light are placed by what the whole clip covers.
std::string frame_hash(const assets::Scene& scene, const std::string& simulation_hash);

}  // namespace softreel::app
