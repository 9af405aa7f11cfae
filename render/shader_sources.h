#pragma once
// GLSL. A program is compiled for exactly what it draws: what a look or a scene does not use is not in it.
#include <string>

namespace softreel::render {

/// What a surface program contains.
struct SurfaceFeatures {
  int lights = 0;           ///< in the uniform block
  bool shadows = false;     ///< some of them have a shadow map
  bool sky_shadow = false;  ///< ambient light has one
  bool texture = false;
  bool sheen = false;
  bool ground = false;  ///< the ground plane: fades with distance
  int shadow_taps = 16;
  auto operator<=>(const SurfaceFeatures&) const = default;
};

std::string surface_vertex_source();
std::string surface_fragment_source(const SurfaceFeatures& features);
/// Depth only, for shadow maps.
std::string shadow_vertex_source();
std::string shadow_fragment_source();
/// One triangle over the whole target that copies a texture, for accumulation.
std::string copy_vertex_source();
std::string copy_fragment_source();

/// Attribute and uniform locations shared by the sources and the code that feeds them.
inline constexpr unsigned kPositionAttribute = 0;
inline constexpr unsigned kNormalAttribute = 1;
inline constexpr unsigned kUvAttribute = 2;
inline constexpr int kWorldFromMeshUniform = 0;  ///< mat4
inline constexpr int kNormalMatrixUniform = 1;   ///< mat3
inline constexpr int kClipFromMeshUniform = 0;   ///< mat4, shadow program
inline constexpr int kFrontColorUniform = 2;     ///< vec4: rgb, metallic
inline constexpr int kBackColorUniform = 3;      ///< vec4: rgb, roughness
inline constexpr int kSheenUniform = 4;          ///< float
inline constexpr unsigned kPassBinding = 0;      ///< uniform block
inline constexpr unsigned kColorTextureUnit = 0;
inline constexpr unsigned kShadowCompareUnit = 1;  ///< sampler2DArrayShadow
inline constexpr unsigned kShadowDepthUnit = 2;    ///< the same maps as plain depths

}  // namespace softreel::render
