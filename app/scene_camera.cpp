#include "app/scene_camera.h"

#include <algorithm>
#include <cmath>

#include "app/convert.h"

namespace softreel::app {
namespace {

glm::vec3 to_vec(const sim::Vec3& v) { return to_glm(Eigen::Vector3d(v)); }

}  // namespace

render::Camera camera_of(const assets::Scene& scene, const ClipExtent& extent,
                         const std::vector<render::ColorBar>& color_bars) {
  render::Camera camera;
  const assets::Camera& c = scene.camera;
  const float whole_aspect = static_cast<float>(scene.render.size[0]) / static_cast<float>(scene.render.size[1]);
  // Colour bars take a part of the right side; what is left of it frames the scene.
  const float bars = std::min(
      0.5f, static_cast<float>(render::color_bars_width(scene.render.size[0], scene.render.size[1], color_bars)) /
                static_cast<float>(scene.render.size[0]));
  const float aspect = whole_aspect * (1 - bars);
  const float fov = static_cast<float>(c.fov);
  camera.fov = fov;
  camera.aperture = static_cast<float>(c.aperture);
  camera.focus = static_cast<float>(c.focus.value_or(0));
  camera.up = to_vec(c.up);
  const bool flat = c.projection == assets::Projection::kOrthographic;
  const auto frame = [&](const glm::vec3& direction) {
    return flat ? render::frame_points_orthographic(extent.points, aspect, direction)
                : render::frame_points(extent.points, fov, aspect, direction);
  };
  if (c.position) {
    camera.position = to_vec(*c.position);
    camera.target = c.target ? to_vec(*c.target) : extent.bounds.centre();
    if (flat)
      camera.height = c.height ? static_cast<float>(*c.height) : frame(camera.position - camera.target).height;
    return camera;
  }
  const render::Camera framed = frame(glm::normalize(to_vec(c.direction)));
  camera.height = flat && c.height ? static_cast<float>(*c.height) : framed.height;
  if (!c.target) {
    camera.position = framed.position;
    camera.target = framed.target;
  } else {
    // Look at the target from as far as the framing asks for.
    camera.target = to_vec(*c.target);
    camera.position =
        camera.target + glm::length(framed.position - framed.target) * glm::normalize(to_vec(c.direction));
  }
  camera.up = to_vec(c.up);
  if (bars > 0 && !c.target) {  // half of that to the side brings the scene into the middle of the rest
    const glm::vec3 ahead = camera.target - camera.position;
    const glm::vec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const float half = flat ? 0.5f * camera.height : glm::length(ahead) * std::tan(glm::radians(fov) / 2);
    const glm::vec3 aside = right * (bars * whole_aspect * half);
    camera.position += aside;
    camera.target += aside;
  }
  return camera;
}

}  // namespace softreel::app
