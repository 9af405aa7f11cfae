#pragma once
// What the visible things of a clip cover: camera, ground, lights and ranges of colour go by it.
#include <memory>
#include <vector>

#include "app/body_figure.h"
#include "app/clip_cache.h"
#include "app/drawn_field.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "render/bounds.h"

namespace softreel::app {

/// Whether camera, ground, lights or the range of a field are placed by what the whole clip covers, so that it has to
/// be simulated before its first picture.
bool needs_whole_clip(const assets::Scene& scene);

/// What the visible things cover over the frames that were added.
struct ClipExtent {
  render::Bounds bounds;                                   ///< of bodies and colliders with an end
  std::vector<FieldRange> field_ranges;                    ///< as scene.fields
  std::vector<std::shared_ptr<const BodyFigure>> figures;  ///< soft bodies, then cloths; null: shows none
  std::vector<FieldRange> figure_ranges;                   ///< as `figures`
  std::vector<glm::vec3> points;  ///< corners of the boxes around each of them in each frame, for framing

  void add(const render::Bounds& box);
};

/// The visible bodies, fields and colliders of one frame.
void add_frame(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& frame, ClipExtent& extent);

}  // namespace softreel::app
