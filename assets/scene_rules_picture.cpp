// Rules for camera, lights and the picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "assets/scene_limits.h"
#include "assets/scene_nearest.h"
#include "assets/scene_rules.h"

namespace softreel::assets {

void apply_quality(Render& render) {
  switch (render.quality) {
    case Quality::kDraft:
      render.samples = 4;
      render.sky_shadow = false;  // a second map in each pass
      break;
    case Quality::kDefault:
      break;
    case Quality::kFinal:
      render.samples = 0;
      break;
  }
}

void check(KeyVisitor& v, const DataView& data) {
  only_for(v, data.colorbar, {"label"}, "is written over the colour bar, and colorbar is false");
  if (data.range && !((*data.range)[0] < (*data.range)[1]))
    v.problem("range", "found two values that do not rise, expected [lowest, highest]");
}

void check(KeyVisitor& v, Camera& c) {
  if (c.view != View::kFree) {
    only_for(v, !c.position.has_value(), {"view"}, "has no effect when position is given; keep one of them");
    only_for(v, false, {"direction"}, "has no effect beside view; keep one of them");
    constexpr std::array<std::array<double, 3>, 7> kDirections = {
        {{0, 0, 1}, {0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}};
    const auto& d = kDirections[static_cast<size_t>(c.view)];
    c.direction = Vec3(d[0], d[1], d[2]);
    if (c.view == View::kTop || c.view == View::kBottom) c.up = Vec3(0, 0, c.view == View::kTop ? -1 : 1);
  }
  for (size_t i = 1; i < c.keys.size(); ++i)
    if (!(c.keys[i].t > c.keys[i - 1].t))
      v.problem(fmt::format("keys.{}.t", i + 1), "is not later than that of the key frame before");
  nonzero(v, "direction", c.direction);
  nonzero(v, "up", c.up);
  only_for(v, !c.position, {"direction"}, "has no effect when position is given; keep one of them");
  const bool flat = c.projection == Projection::kOrthographic;
  only_for(v, flat, {"height"}, "is for projection = \"orthographic\"; a perspective has fov");
  only_for(v, !flat, {"fov"}, "is for projection = \"perspective\"; an orthographic picture has height");
  only_for(v, !flat || c.aperture == 0, {"aperture"}, "is for projection = \"perspective\"");
  only_for(v, c.aperture > 0, {"focus"}, "has no effect without an aperture; everything is sharp");
  if (c.position && c.target && (*c.position - *c.target).norm() < 1e-9)
    return v.problem("target", "is the camera's own position; it would look nowhere");
  if (c.position && !c.target) return;
  const Vec3 view = c.position ? Vec3(*c.position - *c.target) : c.direction;
  if (view.norm() > 0 && view.normalized().cross(c.up.normalized()).norm() < 1e-6)
    v.problem("up", "is the direction in which the camera looks; the picture has no upright. Change up or position");
}

void check_pictures(KeyVisitor& v, const Scene& scene) {
  for (size_t i = 0; i < scene.springs.size(); ++i)
    if (scene.springs[i].data) v.problem(fmt::format("springs.{}.data", i + 1), "is for soft bodies and cloths");
  if (scene.camera.follow.empty()) return;
  std::vector<std::string> names;
  const auto collect = [&](const auto& bodies, const char* kind) {
    for (size_t i = 0; i < bodies.size(); ++i)
      names.push_back(bodies[i].name.empty() ? fmt::format("{}-{}", kind, i + 1) : bodies[i].name);
  };
  collect(scene.soft, "soft");
  collect(scene.cloth, "cloth");
  collect(scene.springs, "springs");
  if (std::find(names.begin(), names.end(), scene.camera.follow) != names.end()) return;
  v.problem("camera.follow", fmt::format("there is no body \"{}\"; there are: {}", scene.camera.follow,
                                         names.empty() ? "none" : join_names(names, true)));
}

void check(KeyVisitor& v, const Light& light) {
  const bool area = light.kind == LightKind::kArea;
  nonzero(v, "direction", light.direction);
  const bool sun = light.kind == LightKind::kSun;
  only_for(v, area, {"radius"}, "is for kind = \"area\"");
  only_for(v, !sun, {"position"}, "is for kind = \"area\" or \"rectangle\"");
  only_for(v, !area && !sun, {"size"}, "is for kind = \"rectangle\"");
  only_for(v, sun, {"angle"}, "is for kind = \"sun\"; an area light has a radius");
  only_for(v, sun || !light.position, {"direction"}, "has no effect when position is given; keep one of them");
}

void check(KeyVisitor& v, const Background& background) {
  if (background.sky && background.transparent)
    v.problem("transparent", "is the opposite of sky = true; keep one of them");
}

void check(KeyVisitor& v, const Render& render) {
  only_for(v, !render.sky_map.empty(), {"sky_turn", "background.sky"}, "is for a sky_map, and none is given");
  only_for(v, render.samples == 0, {"tolerance"}, "is for samples = \"auto\"");
  const double pixels = double(render.size[0]) * render.size[1];
  if (pixels > kMostPixels)
    v.problem("size", fmt::format("{} x {} are {:.0f} pixels, at most {:.0f}", render.size[0], render.size[1], pixels,
                                  kMostPixels));
}

}  // namespace softreel::assets
