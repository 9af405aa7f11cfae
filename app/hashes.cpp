#include "app/hashes.h"

#include "assets/content_hash.h"
#include "assets/scene_canonical.h"

namespace softreel::app {
namespace {

// Raised when the same scene gives other numbers, or other pixels, than before.
constexpr int kSimulationVersion = 1;
constexpr int kPictureVersion = 1;

void add_assets(const assets::Scene& scene, bool physics, assets::ContentHasher& hasher) {
  for (const assets::AssetUse& use : scene.assets)
    if (use.physics == physics) hasher.add(use.key).add(assets::hash_file(scene.asset_path(use.path)));
}

}  // namespace

std::string simulation_hash(const assets::Scene& scene) {
  assets::ContentHasher hasher;
  hasher.add(kSimulationVersion).add(assets::canonical_physics(scene));
  add_assets(scene, true, hasher);
  return hasher.hex();
}

std::string frame_hash(const assets::Scene& scene, const std::string& simulation_hash) {
  assets::ContentHasher hasher;
  hasher.add(kPictureVersion).add(simulation_hash).add(assets::canonical_picture(scene));
  add_assets(scene, false, hasher);
  return hasher.hex();
}

}  // namespace softreel::app
