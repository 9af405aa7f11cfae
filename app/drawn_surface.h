#pragma once
// An imported surface as the renderer wants it.
#include <filesystem>
#include <optional>
#include <string>
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

/// `position_count`: how many positions the physics hands over per frame; `two_sided`: cloth. The scene's `look` wins
/// over what the file brings; `texture`: the scene's own picture, if it names one.
DrawnSurface drawn_surface(const assets::ImportedSurface& surface, int position_count, const assets::Look& look,
                           const std::optional<std::filesystem::path>& texture, bool two_sided);

/// The look alone, for shapes without a file.
render::Look plain_look(const assets::Look& look, const std::optional<std::filesystem::path>& texture, bool two_sided);

}  // namespace softreel::app
