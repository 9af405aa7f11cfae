#include "app/hashes.h"

#include <algorithm>
#include <filesystem>

#include "app/clip_extent.h"
#include "app/world.h"
#include "assets/atomic_file.h"
#include "assets/content_hash.h"
#include "assets/scene_canonical.h"
#include "assets/side_files.h"

namespace softreel::app {
namespace {

// Raised when the same scene gives other numbers, or other pixels, than before.
constexpr int kSimulationVersion = 2;
constexpr int kPictureVersion = 3;

/// The lines of an OBJ's material file that name materials: they decide how the importer cuts the mesh up, and so the
/// order of its vertices.
std::string material_names(const std::string& mtl) {
  std::string names;
  for (std::size_t at = 0; at < mtl.size();) {
    const std::size_t end = std::min(mtl.find('\n', at), mtl.size());
    const std::string line = mtl.substr(at, end - at);
    if (line.find("newmtl") != std::string::npos) names += line + '\n';
    at = end + 1;
  }
  return names;
}

void add_side_files(const std::filesystem::path& mesh, bool physics, assets::ContentHasher& hasher) {
  for (const assets::SideFile& side : assets::side_files(mesh)) {
    const std::string name = side.path.filename().string();
    if (side.physics == physics)
      hasher.add(name).add(assets::hash_file(side.path));
    else if (physics && side.path.extension() == ".mtl")
      hasher.add(name).add(material_names(assets::read_file(side.path)));
  }
}

void add_assets(const assets::Scene& scene, bool physics, assets::ContentHasher& hasher) {
  for (const assets::AssetUse& use : scene.assets) {
    const std::filesystem::path file = scene.asset_path(use.path);
    if (use.physics == physics) hasher.add(use.key).add(assets::hash_file(file));
    if (use.physics) add_side_files(file, physics, hasher);
  }
}

}  // namespace

std::string simulation_hash(const assets::Scene& scene) {
  assets::ContentHasher hasher;
  hasher.add(kSimulationVersion).add(assets::canonical_physics(scene));
  if (scene.time.accuracy) {
    hasher.add(scene.time.frames());  // steps are chosen for the whole clip
    // A pixel is as large as the camera sees it.
    if (scene.time.accuracy->unit == "px") hasher.add(assets::canonical_picture(scene));
  }
  if (shows_pressure(scene)) hasher.add("contact_force");  // its frames hold more
  add_assets(scene, true, hasher);
  return hasher.hex();
}

std::string frame_hash(const assets::Scene& scene, const std::string& simulation_hash) {
  assets::ContentHasher hasher;
  hasher.add(kPictureVersion).add(simulation_hash).add(assets::canonical_picture(scene));
  if (needs_whole_clip(scene)) hasher.add(scene.time.frames());  // a longer clip may be framed from further away
  add_assets(scene, false, hasher);
  return hasher.hex();
}

}  // namespace softreel::app
