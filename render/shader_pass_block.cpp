#include "render/shader_parts.h"

namespace softreel::render {

// Fields and units: pass_uniforms.h.
const char* const kPassBlock = R"(
struct LightData { vec4 place; vec4 color; vec4 extra; vec4 facing; };
struct ShadowData { mat4 map_from_world; mat4 plane_from_world; vec4 filter_size; vec4 depth; };
#define PASS_FIELDS \
  mat4 clip_from_world; \
  mat4 world_from_clip; \
  vec4 picture; \
  vec4 camera; \
  vec4 sky; \
  vec4 ground_light; \
  vec4 ground; \
  vec4 sky_direction; \
  vec4 sky_part; \
  vec4 harmonics[9]; \
  LightData lights[MAX_LIGHTS]; \
  ShadowData shadows[MAX_SHADOWS];
struct PassData { PASS_FIELDS };
layout(std140, binding = 0) uniform PassBlock { PASS_FIELDS } block;
)";

}  // namespace softreel::render
