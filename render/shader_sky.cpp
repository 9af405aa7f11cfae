#include "render/shader_parts.h"

namespace softreel::render {

// The built-in sky is two colours; a panorama brings spherical harmonics for matte surfaces and blurred pictures for
// mirroring ones (panorama.h).
const char* const kSky = R"(
#ifdef PANORAMA
layout(binding = 9) uniform sampler2D panorama;

vec3 panorama_at(vec3 d, float level) {
  const float kPi = 3.14159265358979;
  vec2 at = vec2(0.5 + atan(d.x, -d.z) / (2 * kPi), acos(clamp(d.y, -1, 1)) / kPi);
  return textureLod(panorama, at, level).rgb;
}

vec3 sky_irradiance(vec3 n) {
  vec3 sum = 0.282095 * pass.harmonics[0].rgb + 0.488603 * (n.y * pass.harmonics[1].rgb + n.z * pass.harmonics[2].rgb + n.x * pass.harmonics[3].rgb);
  sum += 1.092548 * (n.x * n.y * pass.harmonics[4].rgb + n.y * n.z * pass.harmonics[5].rgb + n.x * n.z * pass.harmonics[7].rgb);
  sum += 0.315392 * (3 * n.z * n.z - 1) * pass.harmonics[6].rgb + 0.546274 * (n.x * n.x - n.y * n.y) * pass.harmonics[8].rgb;
  return max(sum, 0);
}

vec3 sky_radiance(vec3 r, float roughness) { return panorama_at(r, roughness * (PANORAMA_LEVELS - 1)); }
#else
// A matte surface under a sky above and a glow from below.
vec3 sky_irradiance(vec3 n) { return mix(pass.ground_light.rgb, pass.sky.rgb, 0.5 + 0.5 * n.y); }

// What a surface of that roughness mirrors from direction r: brighter towards the horizon, as skies are, with
// a broad soft box overhead that gives metals and gloss something to show.
vec3 sky_radiance(vec3 r, float roughness) {
  float blur = mix(0.12, 1.0, roughness);
  float up = smoothstep(-blur, blur, r.y);
  float width = 0.02 + blur * blur;
  float horizon = width / (width + 2 * r.y * r.y) * (1 - roughness);
  float box = smoothstep(0.7 - 0.9 * blur, 0.7 + 0.9 * blur, r.y) * (1 - 0.8 * roughness);
  vec3 above = pass.sky.rgb * (0.85 + 0.5 * horizon + 0.9 * box);
  vec3 below = pass.ground_light.rgb * (1 + 0.2 * horizon);
  return mix(mix(below, above, up), sky_irradiance(r), roughness * roughness);
}
#endif
)";

}  // namespace softreel::render
