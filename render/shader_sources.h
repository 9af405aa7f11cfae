#pragma once
// GLSL. A program is compiled for exactly what it draws: what a look or a scene does not use is not in it.
#include <string>

namespace softreel::render {

/// What a lighting program contains.
struct LightingFeatures {
  int lights = 0;              ///< in the uniform block
  unsigned shadow_lights = 0;  ///< bit per light: it has a shadow map; the maps are numbered in the lights' order
  bool rectangles = false;     ///< some light shines to one side only
  bool sky_shadow = false;     ///< ambient light has one, after the lights' maps
  bool sheen = false;
  bool field = false;     ///< some surface is coloured by values: a second result, in the picture's own colours
  bool emission = false;  ///< some surface gives off light
  bool panorama = false;  ///< the sky is a picture
  bool panorama_behind = false;
  bool shadow_catcher = false;  ///< of the ground only the missing light is drawn
  bool ground = false;          ///< the ground plane is there: fades with distance
  int shadow_taps = 12;         ///< map readings for the search of blockers, and again for the penumbra
  auto operator<=>(const LightingFeatures&) const = default;
};

/// What a geometry program contains.
struct GeometryFeatures {
  bool color_texture = false;
  bool field = false;  ///< values per vertex, coloured in the lighting program
  bool normal_texture = false;
  bool roughness_texture = false;
  bool pattern = false;
  bool emission = false;  ///< the target has a second layer for it
  bool emission_texture = false;
  bool id = false;    ///< notes the body's number in place of the facet
  bool wire = false;  ///< edges: lines, which have no plane
  auto operator<=>(const GeometryFeatures&) const = default;
};

std::string geometry_vertex_source(const GeometryFeatures& features);
std::string geometry_fragment_source(const GeometryFeatures& features);
/// One triangle over the whole target.
std::string lighting_vertex_source(const LightingFeatures& features);
std::string lighting_fragment_source(const LightingFeatures& features);
/// Depth only, for shadow maps.
std::string shadow_vertex_source();
std::string shadow_fragment_source();

/// Attribute and uniform locations shared by the sources and the code that feeds them.
inline constexpr unsigned kPositionAttribute = 0;
inline constexpr unsigned kNormalAttribute = 1;
inline constexpr unsigned kUvAttribute = 2;
inline constexpr unsigned kValueAttribute = 3;
inline constexpr unsigned kRestAttribute = 4;
inline constexpr int kWorldFromMeshUniform = 0;  ///< mat4
inline constexpr int kNormalMatrixUniform = 1;   ///< mat3
inline constexpr int kClipFromMeshUniform = 0;   ///< mat4, shadow program
inline constexpr int kFrontColorUniform = 2;     ///< vec4: rgb, metallic
inline constexpr int kBackColorUniform = 3;      ///< vec4: rgb, roughness
inline constexpr int kSheenUniform = 4;          ///< float
inline constexpr int kColorMapUniform = 5;       ///< vec4: row of the map, shading
inline constexpr int kEmissionUniform = 6;       ///< vec3
inline constexpr int kPatternUniform = 7;        ///< vec4: colour, size [m], negative for stripes
inline constexpr int kNormalScaleUniform = 8;    ///< float
inline constexpr int kIdUniform = 9;             ///< float
inline constexpr unsigned kPassBinding = 0;      ///< uniform block
inline constexpr unsigned kColorTextureUnit = 0;
inline constexpr unsigned kShadowCompareUnit = 1;  ///< sampler2DArrayShadow
inline constexpr unsigned kShadowDepthUnit = 2;    ///< the same maps as plain depths
inline constexpr unsigned kSurfaceUnit = 3;        ///< usampler2D: what the geometry program has noted
inline constexpr unsigned kDepthUnit = 4;          ///< sampler2D: its depth
inline constexpr unsigned kColorMapUnit = 5;       ///< sampler2D: colour maps, one row each
inline constexpr unsigned kNormalTextureUnit = 6;
inline constexpr unsigned kRoughnessTextureUnit = 7;
inline constexpr unsigned kEmissionTextureUnit = 8;
inline constexpr unsigned kPanoramaUnit = 9;   ///< sampler2D with the levels of Panorama
inline constexpr unsigned kEmissionUnit = 10;  ///< sampler2D: noted by the geometry program

}  // namespace softreel::render
