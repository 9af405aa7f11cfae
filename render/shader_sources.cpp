#include "render/shader_sources.h"

#include <fmt/format.h>

#include <bit>

#include "render/panorama.h"
#include "render/pass_uniforms.h"
#include "render/shader_parts.h"
#include "render/shader_pass_inputs.h"

namespace softreel::render {

namespace {

std::string header() {
  return fmt::format("#version 450 core\n#define MAX_LIGHTS {}\n#define MAX_SHADOWS {}\n#define PANORAMA_LEVELS {}\n",
                     kMaxLights, kMaxShadowMaps, Panorama::kLevels);
}

/// One call per light with constant indices: llvmpipe reads a uniform array at a computed index lane by lane, which
/// costs more than the light itself.
std::string add_lights(const LightingFeatures& features) {
  std::string calls;
  int map = 0;
  for (int light = 0; light < features.lights; ++light) {
    const bool shadow = ((features.shadow_lights >> light) & 1u) != 0;
    calls += fmt::format("radiance += lit_by(s, facet, pass.lights[{}], {}); ", light, shadow ? map++ : -1);
  }
  return calls;
}

constexpr const char* kGeometryVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
#ifdef UV
layout(location = 2) in vec2 uv;
out vec2 texture_uv;
#endif
#ifdef PATTERN
layout(location = 4) in vec3 rest;
out vec3 rest_position;
#endif
#ifdef FIELD
layout(location = 3) in float value;
out float field_value;
#endif
layout(location = 0) uniform mat4 world_from_mesh;
layout(location = 1) uniform mat3 normal_matrix;
out vec3 world_position;
out vec3 world_normal;
void main() {
  vec4 world = world_from_mesh * vec4(position, 1);
  world_position = world.xyz;
  world_normal = normal_matrix * normal;
#ifdef PATTERN
  rest_position = rest;
#endif
#ifdef UV
  texture_uv = vec2(uv.x, 1 - uv.y);  // pictures are stored from top to bottom
#endif
#ifdef FIELD
  field_value = value;
#endif
  gl_Position = block.clip_from_world * world;
}
)";

std::string defines_of(const GeometryFeatures& f) {
  std::string text;
  const auto define = [&](bool wanted, const char* name) {
    if (wanted) text += fmt::format("#define {}\n", name);
  };
  define(f.color_texture, "TEXTURE");
  define(f.field, "FIELD");
  define(f.normal_texture, "NORMAL_TEXTURE");
  define(f.roughness_texture, "ROUGHNESS_TEXTURE");
  define(f.pattern, "PATTERN");
  define(f.emission, "EMISSION");
  define(f.emission_texture, "EMISSION_TEXTURE");
  define(f.color_texture || f.normal_texture || f.roughness_texture || f.emission_texture, "UV");
  define(f.wire, "WIRE");
  define(f.id, "ID");
  return text;
}

constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_mesh;
void main() { gl_Position = clip_from_mesh * vec4(position, 1); }
)";

}  // namespace

std::string geometry_vertex_source(const GeometryFeatures& features) {
  return header() + defines_of(features) + kPassBlock + kGeometryVertex;
}

std::string geometry_fragment_source(const GeometryFeatures& features) {
  return header() + defines_of(features) + kGeometryMain;
}

std::string lighting_vertex_source(const LightingFeatures& features) {
  const PassInputs inputs = pass_inputs(features);
  return header() + kPassBlock + inputs.outputs + "void main() {\n" + inputs.assign +
         "  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);\n}\n";
}

std::string lighting_fragment_source(const LightingFeatures& features) {
  std::string source = header();
  source += fmt::format("#define SHADOW_TAPS {}\n#define ADD_LIGHTS {}\n", features.shadow_taps, add_lights(features));
  const auto define = [&](bool wanted, const char* name) {
    if (wanted) source += fmt::format("#define {}\n", name);
  };
  define(features.shadow_lights != 0, "SHADOWS");
  define(features.shadow_lights != 0 || features.sky_shadow, "SHADOW_MAPS");
  if (features.sky_shadow) source += fmt::format("#define SKY_SHADOW {}\n", std::popcount(features.shadow_lights));
  define(features.rectangles, "RECTANGLES");
  define(features.sheen, "SHEEN");
  define(features.field, "FIELD");
  define(features.ground, "GROUND");
  define(features.emission, "EMISSION");
  define(features.panorama, "PANORAMA");
  define(features.panorama_behind, "PANORAMA_BEHIND");
  define(features.shadow_catcher, "SHADOW_CATCHER");
  return source + kPassBlock + pass_inputs(features).inputs + kSky + kReflectance + kShadowLookup + kLightingMain;
}

std::string shadow_vertex_source() { return header() + kShadowVertex; }
std::string shadow_fragment_source() { return header() + "void main() {}\n"; }

}  // namespace softreel::render
