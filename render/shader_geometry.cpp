#include "render/shader_parts.h"

namespace softreel::render {

// Four words per pixel: smooth normal, base colour, (roughness, metallic, sheen, 1 = something is here), facet normal.
// Directions as octahedra (Z. Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 3(2), 2014), colours as square roots, so that dark ones keep their steps. Roughness 0 marks the matte ground.
// A field notes its value in the place of the colour, and (row of the colour map, shading, 0, 1/255).
const char* const kGeometryMain = R"(
in vec3 world_position;
in vec3 world_normal;
layout(location = 2) uniform vec4 front_color;  // rgb, metallic
layout(location = 3) uniform vec4 back_color;   // rgb, roughness
layout(location = 4) uniform float sheen;
#ifdef TEXTURE
in vec2 texture_uv;
layout(binding = 0) uniform sampler2D color_texture;
#endif
#ifdef FIELD
in float field_value;
layout(location = 5) uniform vec4 color_map;  // row, shading
#endif
layout(location = 0) out uvec4 result;

uint pack_direction(vec3 n) {
  vec2 p = n.xy / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-30);
  vec2 folded = (1 - abs(p.yx)) * vec2(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
  return packSnorm2x16(n.z < 0 ? folded : p);
}

uint pack_color(vec3 c) {
  uvec3 q = uvec3(sqrt(clamp(c, 0, 1)) * vec3(2047, 2047, 1023) + 0.5);
  return q.x | q.y << 11 | q.z << 22;
}

void main() {
  vec3 base = gl_FrontFacing ? front_color.rgb : back_color.rgb;
#ifdef TEXTURE
  base *= texture(color_texture, texture_uv).rgb;
#endif
  vec3 facet = cross(dFdx(world_position), dFdy(world_position));
  result = uvec4(pack_direction(gl_FrontFacing ? world_normal : -world_normal), pack_color(base),
                 packUnorm4x8(vec4(back_color.a, front_color.a, sheen, 1)), pack_direction(facet));
#ifdef FIELD
  result.y = floatBitsToUint(field_value);
  result.z = uint(color_map.x) | uint(color_map.y * 255 + 0.5) << 8 | 1u << 24;
#endif
}
)";

}  // namespace softreel::render
