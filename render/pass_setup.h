#pragma once
// One accumulation pass: where its lights stand, what its shadow maps see, how that reaches the shaders.
#include <span>
#include <vector>

#include "render/bounds.h"
#include "render/camera.h"
#include "render/environment.h"
#include "render/light.h"
#include "render/pass_uniforms.h"
#include "render/sampling.h"

namespace softreel::render {

/// What is the same for all passes of a picture.
struct PictureSetup {
  Camera camera;  ///< with near and far
  int width = 1;
  int height = 1;
  int passes = 1;  ///< each pass stands for one part in so many of lights and sky
  int shadow_map_size = 1024;
  std::vector<Light> lights;    ///< those that shine
  std::vector<int> shadow_map;  ///< per light: its map, -1 none
  int sky_map = -1;
  int shadow_maps = 0;          ///< how many there are
  std::vector<Bounds> casters;  ///< boxes of the meshes that cast shadows, world
  glm::vec3 focus{0};           ///< the lights' discs face this point
};

struct PassSetup {
  PassUniforms uniforms;
  std::vector<glm::mat4> shadow_clip_from_world;  ///< per shadow map
};

/// Drops lights without strength and gives shadow maps where there is something to shade. Throws std::invalid_argument
/// for a light that makes no sense, or more than kMaxLights of them.
PictureSetup set_up_picture(const Camera& camera, std::span<const Light> lights, const Environment& environment,
                            std::vector<Bounds> casters);

PassSetup set_up_pass(const PictureSetup& picture, const Environment& environment, const PassSample& sample, int pass);

}  // namespace softreel::render
