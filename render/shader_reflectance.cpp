#include "render/shader_parts.h"

namespace softreel::render {

// Metallic-roughness microfacets as in glTF 2.0, appendix B: GGX (B. Walter et al., EGSR 2007) with the
// height-correlated Smith term (E. Heitz, JCGT 3(2), 2014) and Schlick's Fresnel. Energy lost to single scattering is
// given back (C. Fdez-Aguera, JCGT 8(1), 2019); what the surface mirrors is missing from the diffuse part. Everything
// is per unit of "radiance of a white matte surface": the factor pi is in the specular terms.
const char* const kReflectance = R"(
const float kPi = 3.14159265358979;

struct Surface {
  vec3 position;
  vec3 normal;      // towards the viewer
  vec3 view;        // towards the camera
  float n_dot_v;
  vec3 diffuse;     // albedo of the matte part
  vec3 f0;
  float roughness;  // perceptual
  vec3 albedo_specular;  // of the mirroring part under uniform light from everywhere, with multiple scattering
  vec3 gain;        // multiple scattering
  float sheen;
  bool matte;       // the ground
};

// Split-sum factors of F0 and F90: B. Karis, "Physically Based Shading on Mobile", 2014 (a fit to the table of his SIGGRAPH 2013 course).
vec2 environment_factors(float roughness, float n_dot_v) {
  const vec4 c0 = vec4(-1, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1, 0.0425, 1.04, -0.04);
  vec4 r = roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
  return vec2(-1.04, 1.04) * a004 + r.zw;
}

// `widen`: tangent of half the opening under which the light is seen; its blur is added to that of the surface
// (B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013 course).
vec3 specular(Surface s, vec3 to_light, float n_dot_l, float widen) {
  vec3 half_way = normalize(s.view + to_light);
  float n_dot_h = clamp(dot(s.normal, half_way), 0, 1);
  float v_dot_h = clamp(dot(s.view, half_way), 0, 1);
  float alpha = clamp(s.roughness * s.roughness + 0.5 * widen, 0.002, 1);
  float a2 = alpha * alpha;
  float d = n_dot_h * n_dot_h * (a2 - 1) + 1;
  float distribution = a2 / (kPi * d * d);
  float visibility = 0.5 / (n_dot_l * sqrt(s.n_dot_v * s.n_dot_v * (1 - a2) + a2) +
                            s.n_dot_v * sqrt(n_dot_l * n_dot_l * (1 - a2) + a2) + 1e-6);
  float m = 1 - v_dot_h;
  float m2 = m * m;
  vec3 fresnel = s.f0 + (1 - s.f0) * (m2 * m2 * m);
  return kPi * distribution * visibility * fresnel * s.gain;
}

#ifdef SHEEN
// A. Estevez and C. Kulla, "Production Friendly Microfacet Sheen BRDF", 2017; visibility by Neubelt and Pettineo, 2013.
float sheen_term(Surface s, vec3 to_light, float n_dot_l) {
  const float kInverse = 1 / 0.35;
  float n_dot_h = clamp(dot(s.normal, normalize(s.view + to_light)), 0, 1);
  float sin_h = sqrt(max(1 - n_dot_h * n_dot_h, 1e-4));
  float distribution = (2 + kInverse) * pow(sin_h, kInverse) / (2 * kPi);
  return kPi * s.sheen * distribution / (4 * (n_dot_l + s.n_dot_v - n_dot_l * s.n_dot_v) + 1e-4);
}
#endif
)";

}  // namespace softreel::render
