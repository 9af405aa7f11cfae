#include "assets/scene_contact.h"

#include <algorithm>

namespace softreel::assets {

bool has_touching_surfaces(const Scene& scene) {
  const auto own = [](const Body& body) { return body.contact.self; };
  const auto open = [](const Body& body) { return body.contact.others; };
  const auto bodies = std::count_if(scene.soft.begin(), scene.soft.end(), open) +
                      std::count_if(scene.cloth.begin(), scene.cloth.end(), open);
  const auto meshes = std::count_if(scene.colliders.begin(), scene.colliders.end(),
                                    [](const Collider& c) { return c.shape == ColliderShape::kMesh; });
  return (bodies > 0 && bodies + meshes > 1) || std::any_of(scene.soft.begin(), scene.soft.end(), own) ||
         std::any_of(scene.cloth.begin(), scene.cloth.end(), own) ||
         std::any_of(scene.contact.pairs.begin(), scene.contact.pairs.end(),
                     [](const ContactPair& p) { return p.touch; });
}

double sleep_speed(const Scene& scene) {
  const bool colliders = std::any_of(scene.colliders.begin(), scene.colliders.end(),
                                     [](const Collider& c) { return c.shape != ColliderShape::kMesh; });
  if (!(colliders || has_touching_surfaces(scene)) || scene.time.integrator == "static" || scene.time.accuracy)
    return 0;
  constexpr double kOfSlipSpeed = 0.5;  // what sticks creeps so fast at three quarters of the friction that it has
  return scene.contact.sleep_speed.value_or(kOfSlipSpeed * scene.contact.slip_speed);
}

}  // namespace softreel::assets
