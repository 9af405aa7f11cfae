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
#ifdef UV
in vec2 texture_uv;
#endif
#ifdef TEXTURE
layout(binding = 0) uniform sampler2D color_texture;
#endif
#ifdef NORMAL_TEXTURE
layout(binding = 6) uniform sampler2D normal_texture;
layout(location = 8) uniform float normal_scale;
#endif
#ifdef ROUGHNESS_TEXTURE
layout(binding = 7) uniform sampler2D roughness_texture;
#endif
#ifdef EMISSION
layout(location = 6) uniform vec3 emission;
layout(location = 1) out vec4 emitted;
#endif
#ifdef EMISSION_TEXTURE
layout(binding = 8) uniform sampler2D emission_texture;
#endif
#ifdef ID
layout(location = 9) uniform float id;
#endif
#ifdef PATTERN
in vec3 rest_position;
layout(location = 7) uniform vec4 pattern;  // colour, size (negative: stripes)

// Every other field, averaged over the pixel in closed form (I. Quilez, "Filtering the checkerboard pattern", 2017). Moved off
// round numbers, so that a flat face of a body never lies on the border of two cubes.
float other_field() {
  vec3 p = rest_position / abs(pattern.w) + vec3(0.137, 0.149, 0.163);
  vec3 w = max(fwidth(p), 1e-3);
  vec3 i = 2 * (abs(fract((p - 0.5 * w) / 2) - 0.5) - abs(fract((p + 0.5 * w) / 2) - 0.5)) / w;
  return 0.5 - 0.5 * (pattern.w < 0 ? i.x : i.x * i.y * i.z);
}
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

#ifdef NORMAL_TEXTURE
// Without tangents from the file: the frame in which the texture lies, from how place and texture coordinates change from pixel to pixel
// (C. Schueler, "Normal Mapping Without Precomputed Tangents", ShaderX 5, 2006).
vec3 bent_normal(vec3 n) {
  vec3 bump = texture(normal_texture, texture_uv).xyz * 2 - 1;
  bump.xy *= normal_scale;
  vec3 dx = dFdx(world_position), dy = dFdy(world_position);
  vec2 ux = dFdx(texture_uv), uy = dFdy(texture_uv);
  vec3 across_x = cross(dy, n), across_y = cross(n, dx);
  vec3 t = across_x * ux.x + across_y * uy.x;
  vec3 b = -(across_x * ux.y + across_y * uy.y);  // texture_uv.y runs down
  float longest = max(dot(t, t), dot(b, b));
  // The pair (dx, dy) is left-handed where the picture is seen upside down.
  float turn = dot(cross(dx, dy), n) < 0 ? -1 : 1;
  return longest > 0 ? normalize(n * bump.z + turn * inversesqrt(longest) * (t * bump.x + b * bump.y)) : n;
}
#endif

void main() {
  vec3 base = gl_FrontFacing ? front_color.rgb : back_color.rgb;
#ifdef TEXTURE
  base *= texture(color_texture, texture_uv).rgb;
#endif
#ifdef PATTERN
  base = mix(base, pattern.rgb, other_field());
#endif
  vec3 normal = gl_FrontFacing ? world_normal : -world_normal;
#ifdef WIRE
  vec3 facet = normal;
#else
  vec3 facet = cross(dFdx(world_position), dFdy(world_position));
#endif
#ifdef NORMAL_TEXTURE
  normal = bent_normal(normalize(normal));
#endif
  vec2 kind = vec2(back_color.a, front_color.a);
#ifdef ROUGHNESS_TEXTURE
  kind *= texture(roughness_texture, texture_uv).gb;
  kind.x = max(kind.x, 1.0 / 255);
#endif
  result = uvec4(pack_direction(normal), pack_color(base), packUnorm4x8(vec4(kind, sheen, 1)), pack_direction(facet));
#ifdef ID
  result.w = uint(id + 0.5);
#endif
#ifdef EMISSION
  emitted = vec4(emission, 1);
#ifdef EMISSION_TEXTURE
  emitted.rgb *= texture(emission_texture, texture_uv).rgb;
#endif
#endif
#ifdef FIELD
  result.y = floatBitsToUint(field_value);
  result.z = uint(color_map.x) | uint(color_map.y * 255 + 0.5) << 8 | 1u << 24;
#endif
}
)";

}  // namespace softreel::render
