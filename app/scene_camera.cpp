#include "app/scene_camera.h"

#include <algorithm>
#include <cmath>

#include "app/convert.h"

namespace softreel::app {
namespace {

glm::vec3 to_vec(const sim::Vec3& v) { return to_glm(Eigen::Vector3d(v)); }

/// Monotone cubic interpolation (F. Fritsch and R. Carlson, SIAM J. Numer. Anal. 17(2), 1980): smooth, and never beyond
/// two neighbouring keys.
double smooth(const std::vector<double>& t, const std::vector<double>& y, double at) {
  if (at <= t.front()) return y.front();
  if (at >= t.back()) return y.back();
  const auto slope = [&](size_t i) { return (y[i + 1] - y[i]) / (t[i + 1] - t[i]); };
  const auto tangent = [&](size_t i) {
    if (i == 0 || i + 1 == t.size()) return 0.0;  // from rest to rest
    const double before = slope(i - 1), after = slope(i);
    if (before * after <= 0) return 0.0;
    const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
    return 3 * (h0 + h1) / ((2 * h1 + h0) / before + (h1 + 2 * h0) / after);
  };
  const size_t i = static_cast<size_t>(std::upper_bound(t.begin(), t.end(), at) - t.begin()) - 1;
  const double h = t[i + 1] - t[i], s = (at - t[i]) / h;
  return (1 + 2 * s) * (1 - s) * (1 - s) * y[i] + s * (1 - s) * (1 - s) * h * tangent(i) +
         s * s * (3 - 2 * s) * y[i + 1] - s * s * (1 - s) * h * tangent(i + 1);
}

}  // namespace

render::Camera camera_at(const assets::Camera& plan, const render::Camera& still, double t, const glm::vec3& moved) {
  render::Camera camera = still;
  if (!plan.keys.empty()) {
    std::vector<double> times, values(plan.keys.size());
    for (const assets::CameraKey& key : plan.keys) times.push_back(key.t);
    for (int c = 0; c < 3; ++c) {
      for (size_t i = 0; i < values.size(); ++i)
        values[i] = plan.keys[i].position ? (*plan.keys[i].position)(c) : static_cast<double>(still.position[c]);
      camera.position[c] = static_cast<float>(smooth(times, values, t));
      for (size_t i = 0; i < values.size(); ++i)
        values[i] = plan.keys[i].target ? (*plan.keys[i].target)(c) : static_cast<double>(still.target[c]);
      camera.target[c] = static_cast<float>(smooth(times, values, t));
    }
    for (size_t i = 0; i < values.size(); ++i) values[i] = plan.keys[i].fov.value_or(static_cast<double>(still.fov));
    camera.fov = static_cast<float>(smooth(times, values, t));
  }
  if (plan.orbit != 0) camera = render::orbit(camera, camera.target, static_cast<float>(plan.orbit * t));
  camera.position += moved;
  camera.target += moved;
  return camera;
}

render::Camera camera_of(const assets::Scene& scene, const ClipExtent& extent,
                         const std::vector<render::ColorBar>& color_bars) {
  render::Camera camera;
  const assets::Camera& c = scene.camera;
  const float whole_aspect = static_cast<float>(scene.render.size[0]) / static_cast<float>(scene.render.size[1]);
  // Colour bars take a part of the right side; what is left of it frames the scene.
  float bars = 0;
  if (!color_bars.empty())
    bars = std::min(
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
    if (flat) camera.height = c.height ? static_cast<float>(*c.height) : frame(camera.position - camera.target).height;
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
