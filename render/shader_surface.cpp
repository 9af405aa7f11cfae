#include "render/shader_parts.h"

namespace softreel::render {

const char* const kSurfaceMain = R"(
in vec3 world_position;
in vec3 world_normal;
in vec2 texture_uv;
layout(location = 2) uniform vec4 front_color;  // rgb, metallic
layout(location = 3) uniform vec4 back_color;   // rgb, roughness
layout(location = 4) uniform float sheen;
#ifdef TEXTURE
layout(binding = 0) uniform sampler2D color_texture;
#endif
layout(location = 0) out vec4 result;

Surface surface_here() {
  Surface s;
  s.position = world_position;
  s.view = normalize(pass.camera.xyz - world_position);
  s.normal = normalize(world_normal);
  if (!gl_FrontFacing) s.normal = -s.normal;
  // Where an interpolated normal turns away from the viewer, as at silhouettes, it is seen edge-on.
  s.n_dot_v = max(dot(s.normal, s.view), 1e-3);
  vec3 base = gl_FrontFacing ? front_color.rgb : back_color.rgb;
#ifdef TEXTURE
  base *= texture(color_texture, texture_uv).rgb;
#endif
#ifdef GROUND
  s.diffuse = base;
  return s;
#endif
  float metallic = front_color.a;
  s.roughness = clamp(back_color.a, 0.03, 1);
  s.f0 = mix(vec3(0.04), base, metallic);
  vec2 factors = environment_factors(s.roughness, s.n_dot_v);
  float single = factors.x + factors.y;
  s.gain = 1 + s.f0 * (1 / max(single, 0.05) - 1);
  s.albedo_specular = clamp((s.f0 * factors.x + factors.y) * s.gain, 0, 1);
  s.diffuse = base * (1 - metallic) * (1 - s.albedo_specular);
#ifdef SHEEN
  s.sheen = sheen;
#else
  s.sheen = 0;
#endif
  return s;
}

vec3 lit_by(Surface s, vec3 facet, LightData light) {
  vec3 to_light = light.place.xyz;
  float falloff = 1;
  float widen = light.extra.x;
  if (light.place.w > 0.5) {
    vec3 way = light.place.xyz - s.position;
    float distance2 = dot(way, way);
    to_light = way * inversesqrt(distance2);
    distance2 = max(distance2, light.extra.z * light.extra.z);
    if (light.color.w > 0) falloff = light.color.w / distance2;
    widen *= inversesqrt(distance2);
  }
  float n_dot_l = dot(s.normal, to_light);
  if (n_dot_l <= 0) return vec3(0);
  float visible = 1;
#ifdef SHADOWS
  if (light.extra.y >= 0) {
    // The facet's own plane is what the shadow map holds; smooth shading may still see the light where the facet does not.
    vec3 plane = dot(facet, to_light) > 0 ? facet : s.normal;
    visible = light_visible(int(light.extra.y), s.position, plane, clamp(dot(plane, to_light), 0, 1));
    if (visible == 0) return vec3(0);
  }
#endif
#ifdef GROUND
  vec3 reflected = s.diffuse;
#else
  vec3 reflected = s.diffuse + specular(s, to_light, n_dot_l, widen);
#endif
#ifdef SHEEN
  reflected += sheen_term(s, to_light, n_dot_l);
#endif
  return light.color.rgb * (falloff * visible * n_dot_l) * reflected;
}

vec3 lit_by_sky(Surface s, vec3 facet) {
  vec3 glow = s.diffuse * sky_irradiance(s.normal);
#ifdef SHEEN
  float rim = 1 - s.n_dot_v;
  glow += 0.5 * s.sheen * rim * rim * rim * pass.sky.rgb;
#endif
#ifdef GROUND
  vec3 gloss = vec3(0);
#else
  vec3 gloss = s.albedo_specular * sky_radiance(reflect(-s.view, s.normal), s.roughness);
#endif
#ifdef SKY_SHADOW
  // What the bodies hide of the sky is taken away from the exact unshadowed light. The directions are cosine distributed about the
  // vertical: the estimate for another normal is weighted by the ratio of the cosines.
  vec3 up = pass.sky_direction.xyz;
  float n_dot_up = dot(s.normal, up);
  if (n_dot_up > 0) {
    vec3 plane = dot(facet, up) > 0 ? facet : s.normal;
    float hidden = 1 - light_visible(int(pass.sky_direction.w), s.position, plane, clamp(dot(plane, up), 0, 1));
    float weight = min(n_dot_up / max(up.y, 0.1), 2.0);
    glow -= hidden * weight * s.diffuse * pass.sky.rgb;
    gloss *= 1 - 0.7 * hidden * min(weight, 1);
  }
#endif
  return glow + gloss;
}

void main() {
  Surface s = surface_here();
  vec3 facet = normalize(cross(dFdx(world_position), dFdy(world_position)));
  if (dot(facet, s.view) < 0) facet = -facet;
  vec3 radiance = lit_by_sky(s, facet);
#if LIGHTS > 0
  for (int i = 0; i < LIGHTS; ++i) radiance += lit_by(s, facet, pass.lights[i]);
#endif
  // Far above white a single pass only adds sparkle.
  radiance = min(radiance, vec3(32));
  float alpha = 1;
#ifdef GROUND
  alpha = 1 - smoothstep(pass.ground.z, pass.ground.w, distance(world_position.xz, pass.ground.xy));
#endif
  result = vec4(radiance * alpha, alpha);
}
)";

}  // namespace softreel::render
