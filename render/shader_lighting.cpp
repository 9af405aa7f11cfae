#include "render/shader_parts.h"

namespace softreel::render {

const char* const kLightingMain = R"(
layout(binding = 3) uniform usampler2D surface_words;  // shader_geometry.cpp
layout(binding = 4) uniform sampler2D surface_depth;
layout(location = 0) out vec4 result;
#ifdef EMISSION
layout(binding = 10) uniform sampler2D emitted;
#endif
#ifdef FIELD
layout(binding = 5) uniform sampler2D color_maps;
layout(location = 1) out vec4 display;  // in the picture's own colours: no exposure, no tone curve

vec3 field_color(uvec4 words) {
  float value = uintBitsToFloat(words.y);
  int last = textureSize(color_maps, 0).x - 1;
  return texelFetch(color_maps, ivec2(int(clamp(value, 0, 1) * last + 0.5), int(words.z & 255u)), 0).rgb;
}
#endif

vec3 unpack_direction(uint word) {
  vec2 p = unpackSnorm2x16(word);
  vec3 n = vec3(p, 1 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0);
  n.xy += vec2(n.x < 0 ? fold : -fold, n.y < 0 ? fold : -fold);
  return normalize(n);
}

vec3 unpack_color(uint word) {
  vec3 root = vec3(word & 2047u, (word >> 11) & 2047u, word >> 22) / vec3(2047, 2047, 1023);
  return root * root;
}

Surface surface_here(uvec4 words, vec3 position) {
  Surface s;
  s.position = position;
  s.view = normalize(pass.camera.xyz - pass.picture.z * position);
  s.normal = unpack_direction(words.x);
  // Where an interpolated normal turns away from the viewer, as at silhouettes, it is seen edge-on.
  s.n_dot_v = max(dot(s.normal, s.view), 1e-3);
  vec3 base = unpack_color(words.y);
  vec4 kind = unpackUnorm4x8(words.z);
  s.matte = kind.x == 0;
  s.roughness = clamp(kind.x, 0.03, 1);
  s.f0 = mix(vec3(0.04), base, kind.y);
  vec2 factors = environment_factors(s.roughness, s.n_dot_v);
  float single = factors.x + factors.y;
  s.gain = 1 + s.f0 * (1 / max(single, 0.05) - 1);
  s.albedo_specular = clamp((s.f0 * factors.x + factors.y) * s.gain, 0, 1);
  if (s.matte) s.gain = s.albedo_specular = vec3(0);
  s.diffuse = base * (1 - kind.y) * (1 - s.albedo_specular);
  s.sheen = kind.z;
  return s;
}

#ifdef SHADOW_CATCHER
vec3 unshadowed = vec3(0);  // what there would be without shadows
#endif

vec3 lit_by(Surface s, vec3 facet, LightData light, const int map) {
  vec3 to_light = light.place.xyz;
  float falloff = 1;
  float widen = light.extra.x;
  if (light.place.w > 0.5) {
    vec3 way = light.place.xyz - s.position;
    float distance2 = dot(way, way);
    to_light = way * inversesqrt(distance2);
    distance2 = max(distance2, light.extra.y * light.extra.y);
    if (light.color.w > 0) falloff = light.color.w / distance2;
    widen *= inversesqrt(distance2);
#ifdef RECTANGLES
    falloff *= mix(1.0, max(-dot(to_light, light.facing.xyz), 0), light.facing.w);
#endif
  }
  float n_dot_l = dot(s.normal, to_light);
  n_dot_l = max(n_dot_l, 0);
  float visible = 1;
#ifdef SHADOWS
  if (map >= 0) {
    // The facet's own plane is what the shadow map holds; smooth shading may still see the light where the facet does not.
    vec3 plane = dot(facet, to_light) > 0 ? facet : s.normal;
    visible = light_visible(map, s.position, plane, clamp(dot(plane, to_light), 0, 1));
  }
#endif
  vec3 reflected = s.diffuse + specular(s, to_light, n_dot_l, widen);
#ifdef SHEEN
  reflected += sheen_term(s, to_light, n_dot_l);
#endif
  vec3 arriving = light.color.rgb * (falloff * n_dot_l);
#ifdef SHADOW_CATCHER
  unshadowed += arriving * reflected;
#endif
  return arriving * visible * reflected;
}

vec3 lit_by_sky(Surface s, vec3 facet) {
  vec3 glow = s.diffuse * sky_irradiance(s.normal);
#ifdef SHEEN
  float rim = 1 - s.n_dot_v;
  glow += 0.5 * s.sheen * rim * rim * rim * sky_irradiance(s.normal);
#endif
  vec3 gloss = s.albedo_specular * sky_radiance(reflect(-s.view, s.normal), s.roughness);
#ifdef SHADOW_CATCHER
  unshadowed += glow + gloss;
#endif
#ifdef SKY_SHADOW
  // What the bodies hide of the sky is taken away from the exact unshadowed light: one direction in each pass stands for all.
  vec3 towards = pass.sky_direction.xyz;
  float n_dot_l = dot(s.normal, towards);
  if (n_dot_l > 0) {
    vec3 plane = dot(facet, towards) > 0 ? facet : s.normal;
    // What hides the sky throws back light of its own: taken for a surface of middle grey in half shade. Without it, what lies
    // under a sheet would be black.
    const float kThrownBack = 0.2;
    float hidden = (1 - kThrownBack) * (1 - light_visible(SKY_SHADOW, s.position, plane, clamp(dot(plane, towards), 0, 1)));
    // In the mean over all passes no more than there is; the gloss loses as large a part as the matte light.
    vec3 taken = hidden * n_dot_l * pass.sky_part.rgb;
    glow -= s.diffuse * taken;
    gloss *= 1 - 0.7 * hidden * min(n_dot_l * pass.sky_direction.w, 1);
  }
#endif
  return glow + gloss;
}

void main() {
  read_pass();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec4 words = texelFetch(surface_words, pixel, 0);
  bool covered = words.z >= 0x01000000u;
#ifdef FIELD
  uvec4 noted = words;
  bool field = (words.z >> 24) == 1u;
  if (field) words.yz = uvec2(0xffffffffu, 0xff000000u);  // lit as if it were white and matte
#endif
  float depth = texelFetch(surface_depth, pixel, 0).r;
  vec4 at = pass.world_from_clip * vec4(gl_FragCoord.xy * pass.picture.xy - 1, 2 * depth - 1, 1);
  Surface s = surface_here(words, at.xyz / at.w);
  vec3 facet = unpack_direction(words.w);
  if (dot(facet, s.view) < 0) facet = -facet;
  vec3 radiance = lit_by_sky(s, facet);
  ADD_LIGHTS
  float alpha = 1;
#ifdef GROUND
  if (s.matte) alpha = 1 - smoothstep(pass.ground.z, pass.ground.w, distance(s.position.xz, pass.ground.xy));
#endif
#ifdef EMISSION
  radiance += texelFetch(emitted, pixel, 0).rgb;
#endif
  // Far above white a single pass only adds sparkle.
  radiance = min(radiance, vec3(32));
#ifdef SHADOW_CATCHER
  if (s.matte) {
    const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
    alpha *= clamp(1 - dot(radiance, kLuminance) / max(dot(unshadowed, kLuminance), 1e-6), 0, 1);
    radiance = vec3(0);
  }
#endif
  result = covered ? vec4(radiance * alpha, alpha) : vec4(0);
#ifdef PANORAMA_BEHIND
  vec3 behind = panorama_at(normalize(pass.picture.z * at.xyz / at.w - pass.camera.xyz), 0);
  result = vec4(result.rgb + behind * (1 - result.a), 1);
#endif
#ifdef FIELD
  display = vec4(0);
  if (field) {
    // Never brighter than the map: light runs into 1, which it (nearly) is where the usual key light falls from above.
    float light = min(1.18 * (1 - exp(-1.2 * dot(radiance, vec3(0.2126, 0.7152, 0.0722)))), 1);
    float shading = float((noted.z >> 8) & 255u) / 255;
    display = vec4(field_color(noted) * mix(1, light, shading), 1);
    result = vec4(0);
  }
#endif
}
)";

}  // namespace softreel::render
