#include "render/environment.h"

#include <algorithm>

namespace softreel::render {

Stage default_stage(const Bounds& whole_clip, const Camera& camera, bool with_ground, float ground_height) {
  Bounds clip = whole_clip;
  if (clip.empty()) clip = {glm::vec3(-0.5f), glm::vec3(0.5f)};
  const float radius = std::max(clip.radius(), 1e-3f);
  const glm::vec3 centre = clip.centre();

  // Seen from the camera: the key light stands high to the left in front, far enough to light the ground evenly.
  const glm::vec3 to_camera = camera.position - centre;
  glm::vec3 towards(to_camera.x, 0, to_camera.z);
  towards = glm::length(towards) > 1e-4f * radius ? glm::normalize(towards) : glm::vec3(0, 0, 1);
  const glm::vec3 right = glm::cross(glm::vec3(0, 1, 0), towards);
  const glm::vec3 key_direction = glm::normalize(0.50f * towards - 0.75f * right + 1.35f * glm::vec3(0, 1, 0));

  Stage stage;
  Light key = area_light(centre + 8.0f * radius * key_direction, centre, 1.3f * radius, 1.1f);
  key.reference_distance = 0;
  key.color = {1.0f, 0.955f, 0.89f};
  stage.lights.push_back(key);

  // Ground and background meet in one tone: the ground's albedo times the light on it, through the tone curve, is about
  // the background where the fade ends.
  Ground& ground = stage.environment.ground;
  ground.visible = with_ground;
  ground.height = ground_height;
  ground.centre = centre;
  const float reach = std::max(radius, glm::length(to_camera));
  ground.fade_begin = 0.8f * reach;
  ground.fade_end = 4.0f * reach;
  ground.look.color = {0.40f, 0.40f, 0.40f};
  stage.environment.background_top = {0.40f, 0.45f, 0.52f};
  stage.environment.background_bottom = {0.56f, 0.56f, 0.56f};
  return stage;
}

}  // namespace softreel::render
