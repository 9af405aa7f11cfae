// Rules for camera, lights and the picture.
#include <fmt/format.h>

#include <Eigen/Geometry>

#include "assets/scene_limits.h"
#include "assets/scene_rules.h"

namespace softreel::assets {

void apply_quality(Render& render) {
  switch (render.quality) {
    case Quality::kDraft:
      render.samples = 4;
      break;
    case Quality::kDefault:
      break;
    case Quality::kFinal:
      render.samples = 0;
      break;
  }
}

void check(KeyVisitor& v, const Camera& c) {
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

void check(KeyVisitor& v, const Render& render) {
  only_for(v, render.samples == 0, {"tolerance"}, "is for samples = \"auto\"");
  const double pixels = double(render.size[0]) * render.size[1];
  if (pixels > kMostPixels)
    v.problem("size", fmt::format("{} x {} are {:.0f} pixels, at most {:.0f}", render.size[0], render.size[1], pixels,
                                  kMostPixels));
}

}  // namespace softreel::assets
