#include "render/shader_sources.h"

#include <fmt/format.h>

#include "render/pass_uniforms.h"
#include "render/shader_parts.h"

namespace softreel::render {

namespace {

std::string header() {
  return fmt::format("#version 450 core\n#define MAX_LIGHTS {}\n#define MAX_SHADOWS {}\n", kMaxLights, kMaxShadowMaps);
}

constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) uniform mat4 world_from_mesh;
layout(location = 1) uniform mat3 normal_matrix;
out vec3 world_position;
out vec3 world_normal;
out vec2 texture_uv;
void main() {
  vec4 world = world_from_mesh * vec4(position, 1);
  world_position = world.xyz;
  world_normal = normal_matrix * normal;
  texture_uv = vec2(uv.x, 1 - uv.y);  // pictures are stored from top to bottom
  gl_Position = pass.clip_from_world * world;
}
)";

constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_mesh;
void main() { gl_Position = clip_from_mesh * vec4(position, 1); }
)";

constexpr const char* kCopyVertex = R"(
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }
)";

constexpr const char* kCopyFragment = R"(
layout(binding = 0) uniform sampler2D source;
layout(location = 0) out vec4 result;
void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

}  // namespace

std::string surface_vertex_source() { return header() + kPassBlock + kSurfaceVertex; }

std::string surface_fragment_source(const SurfaceFeatures& features) {
  std::string source = header();
  source += fmt::format("#define LIGHTS {}\n#define SHADOW_TAPS {}\n", features.lights, features.shadow_taps);
  const auto define = [&](bool wanted, const char* name) {
    if (wanted) source += fmt::format("#define {}\n", name);
  };
  define(features.shadows, "SHADOWS");
  define(features.shadows || features.sky_shadow, "SHADOW_MAPS");
  define(features.sky_shadow, "SKY_SHADOW");
  define(features.texture, "TEXTURE");
  define(features.sheen, "SHEEN");
  define(features.ground, "GROUND");
  return source + kPassBlock + kReflectance + kShadowLookup + kSurfaceMain;
}

std::string shadow_vertex_source() { return header() + kShadowVertex; }
std::string shadow_fragment_source() { return header() + "void main() {}\n"; }
std::string copy_vertex_source() { return header() + kCopyVertex; }
std::string copy_fragment_source() { return header() + kCopyFragment; }

}  // namespace softreel::render
