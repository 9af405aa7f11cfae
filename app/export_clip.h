#pragma once
// The moving meshes of a clip for other programs.
#include <filesystem>
#include <string>
#include <vector>

#include "app/clip_cache.h"
#include "app/shapes.h"
#include "assets/scene.h"

namespace softreel::app {

/// `format`: "ply" (one surface per body and frame), "vtu" (tetrahedra or triangles with velocities, and clip.pvd for
/// ParaView), "pc2" (one point cache per body and its rest mesh as OBJ, for Blender). Throws UserError (kOutput).
void export_clip(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache,
                 const std::vector<int>& frames, const std::string& format, const std::filesystem::path& folder);

}  // namespace softreel::app
