#pragma once
// The uniform block of one accumulation pass, as std140 lays it out; the same fields as in shader_sources.cpp.
#include <array>
#include <glm/glm.hpp>

namespace softreel::render {

inline constexpr std::size_t kMaxLights = 15;                  ///< per picture
inline constexpr std::size_t kMaxShadowMaps = kMaxLights + 1;  ///< and one for the sky

struct ShadowUniforms {
  glm::mat4 map_from_world{1};    ///< homogeneous: (u, v, depth) in 0..1
  glm::mat4 plane_from_world{1};  ///< planes into that space: the inverse transpose
  glm::vec4 filter{0};  ///< x, y: uv per unit of tangent (perspective) or per metre (parallel); z: size of a texel in
                        ///< the same unit; w: radius of the light's part that this pass stands for [m], or its tangent
  glm::vec4 depth{0};   ///< x near, y far [m], z 1 for perspective, w unused
};

struct LightUniforms {
  glm::vec4 place{0};  ///< position (w = 1), or unit direction towards the light (w = 0), world
  glm::vec4 color{
      0};  ///< rgb: radiance of a white matte surface facing it; w: reference distance squared [m^2], 0 no falloff
  glm::vec4 extra{0};   ///< x: radius [m] or tangent of the part this pass stands for; y: whole radius [m]
  glm::vec4 facing{0};  ///< xyz: unit direction into which a rectangle shines; w: 1 for a rectangle, otherwise 0
};

struct PassUniforms {
  glm::mat4 clip_from_world{1};
  glm::mat4 world_from_clip{1};
  glm::vec4 picture{0};        ///< x, y: 2 / size [1/px]; z: 1 perspective, 0 orthographic
  glm::vec4 camera{0};         ///< xyz position, of an orthographic one the direction towards it; w: number of the pass
  glm::vec4 sky{0};            ///< rgb
  glm::vec4 ground_light{0};   ///< rgb
  glm::vec4 ground{0};         ///< x, z of its centre, begin and end of the fade [m]
  glm::vec4 sky_direction{0};  ///< xyz: towards the part of the sky of this pass
  glm::vec4 sky_part{0};       ///< rgb: light of that part on a white matte surface facing it
  std::array<glm::vec4, 9> harmonics{};  ///< rgb: Panorama::irradiance
  std::array<LightUniforms, kMaxLights> lights{};
  std::array<ShadowUniforms, kMaxShadowMaps> shadows{};
};

}  // namespace softreel::render
