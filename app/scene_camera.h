#pragma once
// Where the scene is seen from.
#include <vector>

#include "app/stage.h"

namespace softreel::app {

/// The scene's camera; `extent` frames the clip where the scene leaves it open. `color_bars` take a part of the
/// picture.
render::Camera camera_of(const assets::Scene& scene, const ClipExtent& extent,
                         const std::vector<render::ColorBar>& color_bars = {});

}  // namespace softreel::app
