#pragma once
// softreel turntable SCENE: one frame of a scene, seen from all around.
#include "app/arguments.h"

namespace softreel::app {

/// The scene's own lights and ground stay where they are, the camera goes round; what is not simulated yet is.
int run_turntable_scene(const TurntableArguments& arguments);

}  // namespace softreel::app
