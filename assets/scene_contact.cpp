#include "assets/scene_contact.h"

#include <algorithm>

namespace softreel::assets {

bool has_touching_surfaces(const Scene& scene) {
  const auto own = [](const Body& body) { return body.contact.self; };
  const auto twice = [](const ContactPair& p) { return p.touch && p.between[0].name == p.between[1].name; };
  const bool self = std::any_of(scene.soft.begin(), scene.soft.end(), own) ||
                    std::any_of(scene.cloth.begin(), scene.cloth.end(), own) ||
                    std::any_of(scene.contact.pairs.begin(), scene.contact.pairs.end(), twice);
  const auto bodies = scene.soft.size() + scene.cloth.size();
  const auto meshes = std::count_if(scene.colliders.begin(), scene.colliders.end(),
                                    [](const Collider& c) { return c.shape == ColliderShape::kMesh; });
  return bodies > 0 && (bodies + static_cast<size_t>(meshes) > 1 || self);
}

}  // namespace softreel::assets
