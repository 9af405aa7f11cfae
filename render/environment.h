#pragma once
// What surrounds the bodies: sky light, ground, background, exposure.
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "render/bounds.h"
#include "render/camera.h"
#include "render/light.h"
#include "render/look.h"

namespace softreel::render {

/// A ground plane without end that receives shadows and fades into the background.
struct Ground {
  bool visible = false;
  float height = 0;             ///< world y [m]
  glm::vec3 centre{0, 0, 0};    ///< about which it fades; y is not used
  float fade_begin = 5;         ///< distance from `centre` up to which it is opaque [m]
  float fade_end = 25;          ///< distance from which only the background is seen [m]
  bool catches_shadow = false;  ///< invisible itself: only the light that bodies take away darkens the background
  Look look;                    ///< matte: its color and pattern
  bool operator==(const Ground&) const = default;
};

class Panorama;

/// Colours are linear; the radiance of a white matte surface under `sky` alone, facing up, is `sky`.
struct Environment {
  glm::vec3 sky{0.42f, 0.46f, 0.52f};           ///< ambient light from above
  glm::vec3 ground_light{0.26f, 0.24f, 0.22f};  ///< ambient light from below
  bool sky_shadow = false;  ///< ambient light is blocked by bodies: in each accumulation pass one more shadow map from
                            ///< one direction of the sky
  std::shared_ptr<const Panorama> panorama;  ///< in place of `sky` and `ground_light`; its sun is not among the lights
  bool panorama_behind = false;              ///< it is the background, too, in place of the colours below
  Ground ground;
  /// Background in the picture's own (display) linear values: what is asked for is what the file holds.
  glm::vec3 background_top{0.40f, 0.45f, 0.52f};
  glm::vec3 background_bottom{0.56f, 0.56f, 0.56f};  ///< same as top: a plain background
  bool transparent = false;                          ///< leave the background out: alpha 0 where nothing is drawn
  float exposure = 1;                                ///< factor on all radiance before the tone curve, > 0
  bool operator==(const Environment&) const = default;
};

/// Good defaults for a scene that says nothing about light: a soft key light over the viewer's shoulder and a sky,
/// sizes taken from the box around the whole clip. The ground, when asked for, lies at `ground_height`.
struct Stage {
  std::vector<Light> lights;
  Environment environment;
};
Stage default_stage(const Bounds& whole_clip, const Camera& camera, bool with_ground, float ground_height = 0);

}  // namespace softreel::render
