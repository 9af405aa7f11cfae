#include "render/shader_sources.h"

#include <fmt/format.h>

#include <bit>

#include "render/pass_uniforms.h"
#include "render/shader_parts.h"

namespace softreel::render {

namespace {

std::string header() {
  return fmt::format("#version 450 core\n#define MAX_LIGHTS {}\n#define MAX_SHADOWS {}\n", kMaxLights, kMaxShadowMaps);
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
#ifdef TEXTURE
layout(location = 2) in vec2 uv;
out vec2 texture_uv;
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
#ifdef TEXTURE
  texture_uv = vec2(uv.x, 1 - uv.y);  // pictures are stored from top to bottom
#endif
#ifdef FIELD
  field_value = value;
#endif
  gl_Position = pass.clip_from_world * world;
}
)";

const char* define_of(GeometryKind kind) {
  return kind == GeometryKind::kTexture ? "#define TEXTURE\n" : kind == GeometryKind::kField ? "#define FIELD\n" : "";
}

constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_mesh;
void main() { gl_Position = clip_from_mesh * vec4(position, 1); }
)";

constexpr const char* kFullTargetVertex = R"(
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }
)";

}  // namespace

std::string geometry_vertex_source(GeometryKind kind) {
  return header() + define_of(kind) + kPassBlock + kGeometryVertex;
}

std::string geometry_fragment_source(GeometryKind kind) { return header() + define_of(kind) + kGeometryMain; }

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
  return source + kPassBlock + kReflectance + kShadowLookup + kLightingMain;
}

std::string shadow_vertex_source() { return header() + kShadowVertex; }
std::string shadow_fragment_source() { return header() + "void main() {}\n"; }
std::string full_target_vertex_source() { return header() + kFullTargetVertex; }

}  // namespace softreel::render
