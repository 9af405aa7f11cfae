#pragma once
// Where the scene is seen from.
#include <vector>

#include "app/clip_extent.h"
#include "render/camera.h"
#include "render/color_bar.h"

namespace softreel::app {

/// The scene's camera; `extent` frames the clip where the scene leaves it open. `color_bars` take a part of the
/// picture.
render::Camera camera_of(const assets::Scene& scene, const ClipExtent& extent,
                         const std::vector<render::ColorBar>& color_bars = {});

/// The camera at the time `t` [s]: along the keys, round the target. `still`: as camera_of gives it; `moved`: how far
/// the body that it follows has come [m].
render::Camera camera_at(const assets::Camera& plan, const render::Camera& still, double t, const glm::vec3& moved);

}  // namespace softreel::app
