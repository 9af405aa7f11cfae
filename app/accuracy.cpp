#include "app/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/convert.h"
#include "app/stage.h"
#include "assets/error.h"
#include "render/camera.h"

namespace softreel::app {
namespace {

[[noreturn]] void refuse(const assets::Scene& scene, const std::string& why) {
  const assets::Accuracy& asked = *scene.time.accuracy;
  throw assets::UserError(
      assets::ErrorKind::kUsage, scene.file.string(),
      fmt::format("time.accuracy = \"{} {}\": {}; take a length such as \"1 mm\"", asked.value, asked.unit, why));
}

double diagonal(const Eigen::VectorXd& x) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(x.data(), 3, x.size() / 3);
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/// Side of a pixel [m] where the middle of the scene is.
double pixel(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& start) {
  ClipExtent extent;
  add_frame(scene, shapes, start, extent);
  if (extent.bounds.empty()) refuse(scene, "nothing of the scene is visible");
  const assets::Camera& c = scene.camera;
  const glm::vec3 middle = extent.bounds.centre();
  const auto fov = static_cast<float>(c.fov);
  const float aspect = static_cast<float>(scene.render.size[0]) / static_cast<float>(scene.render.size[1]);
  glm::vec3 position, ahead;
  if (c.position) {
    position = to_glm(*c.position);
    ahead = (c.target ? to_glm(*c.target) : middle) - position;
  } else {
    const render::Camera framed = render::frame_points(extent.points, fov, aspect, glm::normalize(to_glm(c.direction)));
    ahead = framed.target - framed.position;
    position = c.target ? to_glm(*c.target) - ahead : framed.position;
  }
  const double distance = glm::dot(middle - position, glm::normalize(ahead));
  if (!(distance > 0)) refuse(scene, "the camera does not look towards the middle of the scene");
  return 2 * distance * std::tan(c.fov * std::numbers::pi / 360) / scene.render.size[1];
}

}  // namespace

AccuracyTarget accuracy_target(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& start) {
  const assets::Accuracy& asked = *scene.time.accuracy;
  AccuracyTarget target;
  if (!start.fields.empty()) target.of_range = asked.value / 100;
  if (start.state.x.size() == 0) return target;
  if (asked.unit == "px") {
    target.length = asked.value * pixel(scene, shapes, start);
  } else if (asked.unit == "%") {
    target.length = asked.value / 100 * diagonal(start.state.x);
    if (target.length == 0) refuse(scene, "the bodies of the scene have no size");
  } else {
    target.length = asked.metres();
  }
  return target;
}

void FieldSpans::add(const CachedFrame& frame) {
  low_.resize(frame.fields.size(), HUGE_VAL);
  high_.resize(frame.fields.size(), -HUGE_VAL);
  for (size_t i = 0; i < frame.fields.size(); ++i) {
    low_[i] = std::min(low_[i], frame.fields[i].value.minCoeff());
    high_[i] = std::max(high_[i], frame.fields[i].value.maxCoeff());
  }
}

Eigen::VectorXd scaled_solution(const CachedFrame& frame, const AccuracyTarget& target, const FieldSpans& spans) {
  Eigen::Index size = frame.state.x.size();
  for (const CachedField& f : frame.fields) size += f.value.size();
  Eigen::VectorXd y(size);
  Eigen::Index at = 0;
  const auto put = [&](const Eigen::VectorXd& values, double unit, Eigen::Index vertices) {
    y.segment(at, values.size()) = values / (unit * std::sqrt(static_cast<double>(vertices)));
    at += values.size();
  };
  if (frame.state.x.size() > 0) put(frame.state.x, target.length, frame.state.x.size() / 3);
  for (size_t i = 0; i < frame.fields.size(); ++i) {
    const double span = spans.of(i);  // 0: a field that never changes is right in any unit
    put(frame.fields[i].value, span > 0 ? target.of_range * span : 1, frame.fields[i].value.size());
  }
  return y;
}

}  // namespace softreel::app
