#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>
#include <vector>

namespace softreel::render {

namespace {

/// An up vector that is not along the view.
glm::vec3 usable_up(const glm::vec3& forward, const glm::vec3& up) {
  if (glm::length(glm::cross(forward, up)) > 1e-4f * glm::length(up)) return up;
  return std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
}

struct Frame {
  glm::dvec3 right, up, back;
};

Frame view_frame(const glm::vec3& direction) {
  const glm::vec3 back = glm::normalize(direction);
  const glm::vec3 up = usable_up(-back, {0, 1, 0});
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(up), glm::dvec3(back)));
  return {right, glm::cross(glm::dvec3(back), right), glm::dvec3(back)};
}

void check_framing(float fov, float aspect, const glm::vec3& direction, float margin) {
  if (!(fov > 0 && fov < 180)) throw std::invalid_argument("framing: fov must lie between 0 and 180 degrees");
  if (!(aspect > 0) || !std::isfinite(aspect)) throw std::invalid_argument("framing: aspect must be positive");
  if (!(margin >= 0 && margin < 1)) throw std::invalid_argument("framing: margin must lie in [0, 1)");
  const float length = glm::length(direction);
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("framing: direction must not be zero");
}

/// The constraint of one axis: |s - s0| <= k (d - b) for every point, with s its coordinate across, b its coordinate
/// towards the camera, d the camera's. Both sides are half planes in (s0, d); the extremes of s - k b and s + k b are
/// all that matters.
struct AxisFit {
  double k = 1;
  double high = -1e300;  ///< max of s + k b
  double low = 1e300;    ///< min of s - k b
  void add(double s_high, double s_low, double b) {
    high = std::max(high, s_high + k * b);
    low = std::min(low, s_low - k * b);
  }
  double distance() const { return 0.5 * (high - low) / k; }
  double centre() const { return 0.5 * (high + low); }
};

/// Where the camera, at distance `back`, stands along an axis so that both sides have the same margin. `fit_for` gives
/// the AxisFit for a tangent of half the angle of view; the angle into which the points just fit from there has it.
template <typename FitFor>
double centre_from(double back, double widest, const FitFor& fit_for) {
  double narrow = 0, wide = widest;  // distance() falls with k
  for (int halving = 0; halving < 24; ++halving) {
    const double k = 0.5 * (narrow + wide);
    (fit_for(k).distance() > back ? narrow : wide) = k;
  }
  return fit_for(wide).centre();
}

Camera camera_at(const Frame& frame, double right, double up, double back, double depth_of_target, float fov) {
  Camera camera;
  camera.fov = fov;
  const glm::dvec3 line = right * frame.right + up * frame.up;
  camera.position = glm::vec3(line + back * frame.back);
  camera.target = glm::vec3(line + depth_of_target * frame.back);
  return camera;
}

}  // namespace

glm::mat4 camera_from_world(const Camera& camera) {
  return glm::lookAt(camera.position, camera.target, usable_up(camera.target - camera.position, camera.up));
}

glm::mat4 clip_from_camera(const Camera& camera, float aspect) {
  if (camera.orthographic()) {
    const float up = 0.5f * camera.height;
    return glm::ortho(-up * aspect, up * aspect, -up, up, camera.near, camera.far);
  }
  return glm::perspective(glm::radians(camera.fov), aspect, camera.near, camera.far);
}

LensView through_lens(const Camera& camera, const glm::vec2& disc) {
  LensView view{camera, {0, 0}};
  if (!(camera.aperture > 0) || camera.orthographic() || disc == glm::vec2(0)) return view;
  const glm::mat4 from_world = camera_from_world(camera);
  const glm::vec3 right(from_world[0].x, from_world[1].x, from_world[2].x);
  const glm::vec3 up(from_world[0].y, from_world[1].y, from_world[2].y);
  const glm::vec2 aside = 0.5f * camera.aperture * disc;
  const float focus = camera.focus > 0 ? camera.focus : glm::length(camera.target - camera.position);
  const glm::vec3 moved = aside.x * right + aside.y * up;
  view.camera.position += moved;
  view.camera.target += moved;
  view.shear = aside / focus;
  return view;
}

Camera fit_near_far(Camera camera, const Bounds& bounds) {
  double nearest = 1e300;
  double farthest = -1e300;
  if (bounds.empty()) {
    nearest = 0.1;
    farthest = 100;
  } else {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                             (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                             (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
      const double depth = glm::dot(point - glm::dvec3(camera.position), forward);
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  farthest = std::max(farthest * 1.01, 1e-4);
  // A 32-bit depth buffer resolves about 1e-7 of far / near: 1e4 leaves plenty.
  if (camera.orthographic()) {
    // Depth is linear, and what stands behind the camera's position is seen as well.
    const double slack = std::max(0.01 * (farthest - nearest), 1e-4);
    if (camera.far <= 0) camera.far = static_cast<float>(farthest + slack);
    if (camera.near <= 0) camera.near = static_cast<float>(std::min(nearest, farthest) - slack);
    return camera;
  }
  if (camera.far <= 0) camera.far = static_cast<float>(farthest);
  if (camera.near <= 0) camera.near = static_cast<float>(std::max(nearest * 0.99, camera.far * 1e-4));
  if (camera.near >= camera.far) camera.near = camera.far * 1e-4f;
  return camera;
}

glm::vec3 default_view_direction() { return glm::normalize(glm::vec3(0.55f, 0.38f, 1.0f)); }

Camera frame_points(std::span<const glm::vec3> points, float fov, float aspect, const glm::vec3& direction,
                    float margin) {
  check_framing(fov, aspect, direction, margin);
  static constexpr std::array<glm::vec3, 2> kUnitBox{glm::vec3(-0.5f), glm::vec3(0.5f)};
  if (points.empty()) points = kUnitBox;

  const Frame frame = view_frame(direction);
  const double k_up = std::tan(glm::radians(static_cast<double>(fov)) / 2) * (1.0 - margin);
  AxisFit across{k_up * aspect};
  AxisFit upright{k_up};
  double nearest = -1e300;
  double farthest = 1e300;
  for (const glm::vec3& point : points) {
    const glm::dvec3 p(point);
    const double b = glm::dot(p, frame.back);
    const double s = glm::dot(p, frame.right);
    const double u = glm::dot(p, frame.up);
    across.add(s, s, b);
    upright.add(u, u, b);
    nearest = std::max(nearest, b);
    farthest = std::min(farthest, b);
  }
  // A single point, or a line along the view, leaves no size to fit: keep some distance.
  const double size =
      std::max({nearest - farthest, across.distance() * across.k, upright.distance() * upright.k, 1e-3});
  const double back = std::max({across.distance(), upright.distance(), nearest + 0.05 * size});
  const auto fit_along = [&](const glm::dvec3& axis) {
    return [&, axis](double k) {
      AxisFit fit{k};
      for (const glm::vec3& point : points) {
        const glm::dvec3 p(point);
        fit.add(glm::dot(p, axis), glm::dot(p, axis), glm::dot(p, frame.back));
      }
      return fit;
    };
  };
  return camera_at(frame, centre_from(back, across.k, fit_along(frame.right)),
                   centre_from(back, upright.k, fit_along(frame.up)), back, 0.5 * (nearest + farthest), fov);
}

Camera frame_points_orthographic(std::span<const glm::vec3> points, float aspect, const glm::vec3& direction,
                                 float margin) {
  constexpr float kAnyFov = 40;
  check_framing(kAnyFov, aspect, direction, margin);
  static constexpr std::array<glm::vec3, 2> kUnitBox{glm::vec3(-0.5f), glm::vec3(0.5f)};
  if (points.empty()) points = kUnitBox;
  const Frame frame = view_frame(direction);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::vec3& point : points) {
    const glm::dvec3 p(point);
    const glm::dvec3 seen(glm::dot(p, frame.right), glm::dot(p, frame.up), glm::dot(p, frame.back));
    low = glm::min(low, seen);
    high = glm::max(high, seen);
  }
  const glm::dvec3 size = high - low, middle = 0.5 * (low + high);
  const double covered = std::max({size.y, size.x / aspect, 1e-3}) / (1.0 - margin);
  Camera camera = camera_at(frame, middle.x, middle.y, high.z + covered, middle.z, kAnyFov);
  camera.height = static_cast<float>(covered);
  return camera;
}

Camera frame_bounds(const Bounds& bounds, float fov, float aspect, const glm::vec3& direction, float margin) {
  std::vector<glm::vec3> corners;
  if (!bounds.empty())
    for (int corner = 0; corner < 8; ++corner)
      corners.emplace_back((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                           (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                           (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
  return frame_points(corners, fov, aspect, direction, margin);
}

Camera frame_turntable(std::span<const glm::vec3> points, const glm::vec3& axis, float fov, float aspect,
                       const glm::vec3& direction, float margin) {
  check_framing(fov, aspect, direction, margin);
  if (points.empty()) return frame_points(points, fov, aspect, direction, margin);
  // Turning a point about the axis draws a circle of radius r at height y. Seen by the camera, whose view contains the
  // vertical, the circle spans +-r across, and towards the camera and up an ellipse; the extremes of a linear form over
  // the circle have a closed form, so that no angle is left out.
  const Frame frame = view_frame(direction);
  const glm::dvec3 foot(axis.x, 0, axis.z);
  const double k_up = std::tan(glm::radians(static_cast<double>(fov)) / 2) * (1.0 - margin);
  const double k_across = k_up * aspect;
  const auto horizontal = [](const glm::dvec3& v) { return std::hypot(v.x, v.z); };
  double high = -1e300;
  double low = 1e300;
  double distance = -1e300;
  double nearest = -1e300;
  double farthest = 1e300;
  for (const glm::vec3& point : points) {
    const glm::dvec3 p(point);
    const double r = std::hypot(p.x - foot.x, p.z - foot.z);
    const glm::dvec3 form_high = frame.up + k_up * frame.back;
    const glm::dvec3 form_low = frame.up - k_up * frame.back;
    high = std::max(high, form_high.y * p.y + r * horizontal(form_high));
    low = std::min(low, form_low.y * p.y - r * horizontal(form_low));
    // Across: the axis stays in the middle, so d >= max(s / k + b) over the circle.
    const glm::dvec3 form_side = frame.right / k_across + frame.back;
    distance = std::max(distance, form_side.y * p.y + r * horizontal(form_side));
    nearest = std::max(nearest, frame.back.y * p.y + r * horizontal(frame.back));
    farthest = std::min(farthest, frame.back.y * p.y - r * horizontal(frame.back));
  }
  const double size = std::max({nearest - farthest, high - low, 1e-3});
  const double back = std::max({distance, 0.5 * (high - low) / k_up, nearest + 0.05 * size});
  std::vector<glm::dvec2> circles;  // radius, height
  for (const glm::vec3& point : points)
    circles.emplace_back(std::hypot(point.x - foot.x, point.z - foot.z), static_cast<double>(point.y));
  const double middle = centre_from(back, k_up, [&](double k) {
    const glm::dvec3 form_high = frame.up + k * frame.back, form_low = frame.up - k * frame.back;
    const double wide_high = horizontal(form_high), wide_low = horizontal(form_low);
    AxisFit fit{k};
    for (const glm::dvec2& circle : circles) {
      fit.high = std::max(fit.high, form_high.y * circle.y + circle.x * wide_high);
      fit.low = std::min(fit.low, form_low.y * circle.y - circle.x * wide_low);
    }
    return fit;
  });
  Camera camera = camera_at(frame, 0, middle, back, 0.5 * (nearest + farthest), fov);
  camera.position += glm::vec3(foot);
  camera.target += glm::vec3(foot);
  return camera;
}

Camera orbit(const Camera& camera, const glm::vec3& axis, float angle) {
  const double a = glm::radians(static_cast<double>(angle));
  const auto turn = [&](const glm::vec3& v) {
    return glm::vec3(std::cos(a) * v.x + std::sin(a) * v.z, v.y, -std::sin(a) * v.x + std::cos(a) * v.z);
  };
  Camera turned = camera;
  turned.position = turn(camera.position - axis) + axis;
  turned.target = turn(camera.target - axis) + axis;
  turned.up = turn(camera.up);
  return turned;
}

}  // namespace softreel::render
