#include "render/shader_parts.h"

namespace softreel::render {

// Every pass sees one point of the light, and stands for the part of the light around it. Its hard shadow is blurred by
// as much as that part alone would blur it: percentage-closer soft shadows (R. Fernando, NVIDIA 2005) on 1/N of the
// light. So one pass already gives a soft penumbra, and sixteen have no steps in it. Bias: the receiver's plane is
// known exactly in the map's space, so every tap is compared with the depth of the plane under it (J. Isidoro, "Shadow
// Mapping: GPU-based Tips and Techniques", GDC 2006, without screen-space derivatives); what is left, the texel's own
// width and curvature, is covered by an offset along the normal.
const char* const kShadowLookup = R"(
#ifdef SHADOW_MAPS
layout(binding = 1) uniform sampler2DArrayShadow shadow_compare;
layout(binding = 2) uniform sampler2DArray shadow_depth;

float linear_depth(vec4 range, float z) {
  return range.z > 0.5 ? range.x * range.y / (range.y - z * (range.y - range.x)) : mix(range.x, range.y, z);
}

// Turn and radius of a pixel's taps. J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", 2014:
// neighbours get turns that differ evenly. From pass to pass both go along M. Roberts' R2 sequence (2018), so that what few
// taps miss is what the other passes look at, and no grain is left of it in the mean.
vec2 pixel_offset() {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return fract(vec2(noise, 0.5) + vec2(0.5698402910, 0.7548776662) * pass.camera.w);
}

// Points evenly over the unit disc (H. Vogel, Mathematical Biosciences 44, 1979): each is turned by the golden angle
// against the one before.
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

const float kWidest = 0.12;            // blur, in parts of the map
const float kFarthest = 1.0 - 1e-6;  // nearer than where the map is empty

// 0 in full shadow, 1 in full light. `normal`: of the surface as it is, unit, towards the light.
float light_visible(int map, vec3 position, vec3 normal, float n_dot_l) {
  ShadowData s = pass.shadows[map];
  bool perspective = s.depth.z > 0.5;
  vec4 at = s.map_from_world * vec4(position, 1);
  float texel = s.filter_size.z * (perspective ? at.w : 1.0);  // [m] at this distance
  vec3 lifted = position + normal * (texel * (0.4 + 1.4 * sqrt(max(1 - n_dot_l * n_dot_l, 0))));
  at = s.map_from_world * vec4(lifted, 1);
  vec3 p = at.xyz / at.w;
  // llvmpipe runs both sides of an if, but leaves a loop when nobody is in it any more: what need not be done is a loop of no turns.
  // Beside the map, as far as a penumbra can reach, there is no caster but there may be half shadow.
  bool inside = at.w > 0 && all(lessThan(abs(p.xy - 0.5), vec2(0.5 + kWidest))) && p.z > 0 && n_dot_l > 0;
  int taps = inside ? SHADOW_TAPS : 0;

  vec4 plane = s.plane_from_world * vec4(normal, -dot(normal, lifted));
  vec2 texel_uv = 1.0 / vec2(textureSize(shadow_depth, 0).xy);
  vec2 slope = -plane.xy / (abs(plane.z) > 1e-12 ? plane.z : 1e-12);
  // Almost edge-on the plane says nothing useful any more. Limit: the depth range over a hundredth of the map.
  slope = clamp(slope, vec2(-100), vec2(100));
  float z = min(p.z, 1.0) - dot(abs(slope), 0.6 * texel_uv) - 1e-6;
  bool beyond = p.z >= 1;
  if (beyond) { slope = vec2(0); z = kFarthest; }

  float here = linear_depth(s.depth, p.z);
  float reach = s.filter_size.w * (perspective ? max(1 / s.depth.x - 1 / here, 0) : max(here - s.depth.x, 0));
  vec2 search = min(reach * s.filter_size.xy, vec2(kWidest));
  // A small light, or many passes: its hard shadow, smoothed over a texel, is enough.
  search = max(search, 1.2 * texel_uv);

  // A direction on the half circle, without trigonometry.
  vec2 offset = pixel_offset();
  float turn = 2 * offset.x - 1;
  vec2 first_direction = vec2(1 - turn * turn, 2 * turn) / (1 + turn * turn);
  vec2 direction = first_direction;
  float blocker = 0;
  float blockers = 0;
  for (int i = 0; i < taps; ++i) {
    vec2 d = sqrt((float(i) + 0.5) / SHADOW_TAPS) * direction * search;
    direction = kGoldenTurn * direction;
    float stored = textureLod(shadow_depth, vec3(p.xy + d, map), 0).r;
    float in_front = stored < min(z + dot(d, slope), kFarthest) ? 1.0 : 0.0;
    blocker += in_front * stored;
    blockers += in_front;
  }
  // The search reaches wider than the penumbra: nothing found is full light. Nothing but blockers is no full shadow yet: where
  // they are close, as in a fold, the penumbra is narrow and may miss them.
  taps = blockers > 0 ? SHADOW_TAPS : 0;
  blocker = linear_depth(s.depth, blocker / max(blockers, 1));
  float width = s.filter_size.w * (perspective ? max(1 / blocker - 1 / here, 0) : max(here - blocker, 0));
  vec2 radius = clamp(width * s.filter_size.xy, 1.2 * texel_uv, vec2(kWidest));
  direction = first_direction;
  float light = 0;
  for (int i = 0; i < taps; ++i) {
    vec2 d = sqrt((float(i) + offset.y) / SHADOW_TAPS) * direction * radius;
    direction = kGoldenTurn * direction;
    light += texture(shadow_compare, vec4(p.xy + d, map, min(z + dot(d, slope), kFarthest)));
  }
  return taps > 0 ? light / taps : 1.0;
}
#endif
)";

}  // namespace softreel::render
