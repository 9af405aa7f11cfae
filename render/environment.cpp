#include "render/environment.h"

#include <algorithm>

namespace softreel::render {

Stage default_stage(const Bounds& whole_clip, const Camera& camera, bool with_ground, float ground_height) {
  Bounds clip = whole_clip;
  if (clip.empty()) clip = {glm::vec3(-0.5f), glm::vec3(0.5f)};
  const float radius = std::max(clip.radius(), 1e-3f);
  const glm::vec3 centre = clip.centre();

  // Seen from the camera: the key light stands high to the left in front, three radii away and half a radius wide.
  const glm::vec3 to_camera = camera.position - centre;
  glm::vec3 towards(to_camera.x, 0, to_camera.z);
  towards = glm::length(towards) > 1e-4f * radius ? glm::normalize(towards) : glm::vec3(0, 0, 1);
  const glm::vec3 right = glm::cross(glm::vec3(0, 1, 0), towards);
  const glm::vec3 key_direction = glm::normalize(0.55f * towards - 0.75f * right + 1.25f * glm::vec3(0, 1, 0));

  Stage stage;
  Light key = area_light(centre + 4.5f * radius * key_direction, centre, 0.9f * radius, 1.05f);
  key.color = {1.0f, 0.955f, 0.89f};
  stage.lights.push_back(key);

  Ground& ground = stage.environment.ground;
  ground.visible = with_ground;
  ground.height = ground_height;
  ground.centre = centre;
  const float reach = std::max(radius, glm::length(to_camera));
  ground.fade_begin = 1.2f * reach;
  ground.fade_end = 5.0f * reach;
  ground.look.color = {0.42f, 0.415f, 0.405f};
  ground.look.roughness = 0.85f;
  return stage;
}

}  // namespace softreel::render
