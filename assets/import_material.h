#pragma once
// What a file says about the look of a mesh.
#include <filesystem>

#include "assets/surface_import.h"

struct aiScene;
struct aiMesh;

namespace softreel::assets {

/// Name, base colour, metallic, roughness, emission and textures of the mesh's material; the triangle range is left
/// alone. A texture that is named but not found under `folder` goes to `missing`.
SurfacePart import_material(const aiScene& scene, const aiMesh& mesh, const std::filesystem::path& folder,
                            std::vector<std::string>& missing);

}  // namespace softreel::assets
