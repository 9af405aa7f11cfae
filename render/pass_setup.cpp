#include "render/pass_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "render/panorama.h"
#include "render/shadow_frustum.h"

namespace softreel::render {

namespace {

void check_light(const Light& light) {
  const bool finite = std::isfinite(light.intensity) && std::isfinite(light.radius) &&
                      std::isfinite(glm::length(light.position)) && std::isfinite(glm::length(light.direction));
  if (!finite) throw std::invalid_argument("light: a value is not finite");
  if (light.intensity < 0) throw std::invalid_argument("light: intensity must not be negative");
  if (light.kind != LightKind::kSun && (light.radius < 0 || light.reference_distance < 0))
    throw std::invalid_argument("light: radius and reference distance must not be negative");
  if (light.kind == LightKind::kRectangle &&
      !(light.size.x >= 0 && light.size.y >= 0 && light.size.x + light.size.y < 1e9f))
    throw std::invalid_argument("light: sizes must be finite and not negative");
  if (light.kind != LightKind::kSphere && !(glm::length(light.direction) > 0))
    throw std::invalid_argument("light: direction must not be zero");
  if (light.kind == LightKind::kSun && !(light.angular_diameter >= 0 && light.angular_diameter < 170))
    throw std::invalid_argument("light: angular diameter must lie in [0, 170) degrees");
}

/// Two unit vectors across `axis` (unit).
std::pair<glm::vec3, glm::vec3> across(const glm::vec3& axis) {
  const glm::vec3 helper = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(helper, axis));
  return {u, glm::cross(axis, u)};
}

glm::mat4 pass_clip_from_world(const PictureSetup& picture, const LensView& lens, const glm::vec2& pixel) {
  const glm::vec2 size(picture.width, picture.height);
  glm::mat4 clip = clip_from_camera(lens.camera, size.x / size.y);
  // Depth is -z.
  clip[2].x -= clip[0].x * lens.shear.x;
  clip[2].y -= clip[1].y * lens.shear.y;
  // Upside down, so that rows are read back from top to bottom; and moved by a part of a pixel.
  for (int column = 0; column < 4; ++column) {
    clip[column].y = -clip[column].y;
    clip[column].x += 2 * pixel.x / size.x * clip[column].w;
    clip[column].y += 2 * pixel.y / size.y * clip[column].w;
  }
  return clip * camera_from_world(lens.camera);
}

/// Fills the light's uniforms for `point` of it, and its shadow map when it has one. `radius`: of a disc as large as
/// the light.
void place_point(const PictureSetup& picture, const Light& light, const glm::vec3& point, float radius, int map,
                 LightUniforms& out, PassSetup& setup) {
  const float part = radius / std::sqrt(static_cast<float>(picture.passes));
  out.place = glm::vec4(point, 1);
  out.color = glm::vec4(light.intensity * light.color, light.reference_distance * light.reference_distance);
  out.extra = glm::vec4(part, std::max(radius, 1e-3f), 0, 0);
  if (map < 0) return;
  const ShadowFrustum frustum = frustum_from_point(point, picture.casters, picture.shadow_map_size, part);
  setup.uniforms.shadows[static_cast<std::size_t>(map)] = frustum.uniforms;
  setup.shadow_clip_from_world[static_cast<std::size_t>(map)] = frustum.clip_from_world;
}

void place_sphere(const PictureSetup& picture, const Light& light, const glm::vec2& square, int map, LightUniforms& out,
                  PassSetup& setup) {
  const glm::vec3 way = picture.focus - light.position;
  const auto [u, v] = across(glm::length(way) > 0 ? glm::normalize(way) : glm::vec3(0, -1, 0));
  const glm::vec2 disc = disc_from_square(square);
  place_point(picture, light, light.position + light.radius * (disc.x * u + disc.y * v), light.radius, map, out, setup);
}

void place_rectangle(const PictureSetup& picture, const Light& light, const glm::vec2& square, int map,
                     LightUniforms& out, PassSetup& setup) {
  const glm::vec3 facing = glm::normalize(light.direction);
  const auto [u, v] = across(facing);
  const glm::vec2 at = (square - 0.5f) * light.size;
  const float radius = std::sqrt(light.size.x * light.size.y / std::numbers::pi_v<float>);
  out.facing = glm::vec4(facing, 1);
  place_point(picture, light, light.position + at.x * u + at.y * v, radius, map, out, setup);
}

void place_parallel(const PictureSetup& picture, const glm::vec3& towards, float part_tangent, int map,
                    PassSetup& setup) {
  if (map < 0) return;
  const ShadowFrustum frustum = frustum_along(towards, picture.casters, picture.shadow_map_size, part_tangent);
  setup.uniforms.shadows[static_cast<std::size_t>(map)] = frustum.uniforms;
  setup.shadow_clip_from_world[static_cast<std::size_t>(map)] = frustum.clip_from_world;
}

void place_sun(const PictureSetup& picture, const Light& light, const glm::vec2& square, int map, LightUniforms& out,
               PassSetup& setup) {
  const glm::vec2 disc = disc_from_square(square);
  const glm::vec3 axis = -glm::normalize(light.direction);
  const auto [u, v] = across(axis);
  const float tangent = std::tan(glm::radians(0.5f * light.angular_diameter));
  const glm::vec3 towards = glm::normalize(axis + tangent * (disc.x * u + disc.y * v));
  const float part = tangent / std::sqrt(static_cast<float>(picture.passes));
  out.place = glm::vec4(towards, 0);
  out.color = glm::vec4(light.intensity * light.color, 0);
  out.extra = glm::vec4(part, 0, 0, 0);
  place_parallel(picture, towards, part, map, setup);
}

struct SkyPart {
  glm::vec3 towards;
  glm::vec3 part;  // light on a white matte surface facing it, were all the sky's light like this
  float weight;    // the same without colour, of a sky of strength 1
};

SkyPart sky_part(const Environment& environment, const glm::vec2& square) {
  if (environment.panorama) {
    const Panorama::Sample sample = environment.panorama->sample(square);
    return {sample.towards, sample.part, 1};
  }
  // Evenly over the disc under the hemisphere: with the cosine about the vertical, so it is divided by that.
  const glm::vec2 disc = disc_from_square(square);
  const float height = std::sqrt(std::max(1 - glm::dot(disc, disc), 0.0f));
  const glm::vec3 towards = glm::normalize(glm::vec3(disc.x, std::max(height, 0.02f), disc.y));
  const float weight = 1 / std::max(towards.y, 0.1f);
  return {towards, weight * environment.sky, weight};
}

}  // namespace

PictureSetup set_up_picture(const Camera& camera, std::span<const Light> lights, const Environment& environment,
                            std::vector<Bounds> casters) {
  PictureSetup picture;
  picture.camera = camera;
  picture.casters = std::move(casters);
  Bounds all;
  for (const Bounds& box : picture.casters) all.add(box);
  picture.focus = all.empty() ? camera.target : all.centre();
  for (const Light& light : lights) {
    check_light(light);
    if (light.intensity == 0 || light.color == glm::vec3(0)) continue;
    const bool shadow = light.casts_shadow && !picture.casters.empty();
    picture.lights.push_back(light);
    picture.shadow_map.push_back(shadow ? picture.shadow_maps++ : -1);
  }
  if (picture.lights.size() > kMaxLights)
    throw std::invalid_argument(fmt::format("{} lights; at most {} can shine", picture.lights.size(), kMaxLights));
  if (environment.sky_shadow && (environment.panorama || environment.sky != glm::vec3(0)) && !picture.casters.empty())
    picture.sky_map = picture.shadow_maps++;
  return picture;
}

PassSetup set_up_pass(const PictureSetup& picture, const Environment& environment, const PassSample& sample, int pass) {
  PassSetup setup;
  PassUniforms& uniforms = setup.uniforms;
  setup.shadow_clip_from_world.resize(static_cast<std::size_t>(picture.shadow_maps));
  const LensView lens = through_lens(picture.camera, sample.lens);
  uniforms.clip_from_world = pass_clip_from_world(picture, lens, sample.pixel);
  uniforms.world_from_clip = glm::mat4(glm::inverse(glm::dmat4(uniforms.clip_from_world)));
  uniforms.picture = glm::vec4(2.0f / static_cast<float>(picture.width), 2.0f / static_cast<float>(picture.height),
                               picture.camera.orthographic() ? 0 : 1, 0);
  const Camera& eye = lens.camera;
  uniforms.camera = glm::vec4(eye.orthographic() ? glm::normalize(eye.position - eye.target) : eye.position,
                              static_cast<float>(pass % 64));
  uniforms.sky = glm::vec4(environment.sky, 0);
  uniforms.ground_light = glm::vec4(environment.ground_light, 0);
  if (environment.panorama)
    for (std::size_t k = 0; k < uniforms.harmonics.size(); ++k)
      uniforms.harmonics[k] = glm::vec4(environment.panorama->irradiance()[k], 0);
  const Ground& ground = environment.ground;
  uniforms.ground = glm::vec4(ground.centre.x, ground.centre.z, ground.fade_begin,
                              std::max(ground.fade_end, ground.fade_begin * 1.001f));
  for (std::size_t i = 0; i < picture.lights.size(); ++i) {
    const Light& light = picture.lights[i];
    const auto place = light.kind == LightKind::kSphere      ? place_sphere
                       : light.kind == LightKind::kRectangle ? place_rectangle
                                                             : place_sun;
    place(picture, light, sample.lights[i], picture.shadow_map[i], uniforms.lights[i], setup);
  }
  if (picture.sky_map >= 0) {
    const SkyPart sky = sky_part(environment, sample.sky);
    uniforms.sky_part = glm::vec4(sky.part, 0);
    // 1/N of the unit disc under the hemisphere, seen as a cone.
    const float part = std::min(1 / std::sqrt(static_cast<float>(picture.passes)), 0.7f);
    uniforms.sky_direction = glm::vec4(sky.towards, sky.weight);
    place_parallel(picture, sky.towards, part / std::sqrt(1 - part * part), picture.sky_map, setup);
  }
  return setup;
}

}  // namespace softreel::render
