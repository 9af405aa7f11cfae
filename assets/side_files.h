#pragma once
// Files that a mesh file refers to: what is up to date depends on their content too.
#include <filesystem>
#include <vector>

namespace softreel::assets {

struct SideFile {
  std::filesystem::path path;
  bool physics = false;  ///< buffers and tetrahedra; otherwise materials and textures
};

/// The existing files whose names stand in a mesh file (buffers and textures of glTF, materials of OBJ and their
/// textures, textures of FBX, COLLADA, ...), and the other half of a .node/.ele pair. Found by their extensions in the
/// file's bytes, looked for where the importer looks; no format is parsed. In a fixed order, each once.
/// Throws UserError(kInput) when `mesh` cannot be read.
std::vector<SideFile> side_files(const std::filesystem::path& mesh);

}  // namespace softreel::assets
