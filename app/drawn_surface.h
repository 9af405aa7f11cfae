#pragma once
// An imported surface as the renderer wants it.
#include <vector>

#include "assets/scene.h"
#include "assets/surface_import.h"
#include "render/look.h"
#include "render/surface_mesh.h"

namespace softreel::app {

struct DrawnSurface {
  render::SurfaceMesh mesh;
  std::vector<render::Look> looks;  ///< one for each part
};

/// `position_count`: how many positions the physics hands over per frame; `two_sided`: cloth. The `look` of the scene
/// wins over what the file brings; `transform`: with which the surface was placed.
DrawnSurface drawn_surface(const assets::Scene& scene, const assets::ImportedSurface& surface, int position_count,
                           const assets::Look& look, const assets::Transform& transform, bool two_sided);

/// The look alone, for shapes without a file.
render::Look plain_look(const assets::Scene& scene, const assets::Look& look, bool two_sided);

}  // namespace softreel::app
