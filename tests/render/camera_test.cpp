#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "render/camera.h"

using namespace softreel::render;

namespace {

std::vector<glm::vec3> random_points(std::uint32_t seed, std::size_t count) {
  std::mt19937 bits(seed);
  const auto unit = [&] { return static_cast<float>(bits()) * 0x1p-32f; };
  const glm::vec3 size(0.1f + 5 * unit(), 0.1f + 3 * unit(), 0.1f + 5 * unit());
  const glm::vec3 offset(10 * unit() - 5, 10 * unit() - 5, 10 * unit() - 5);
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(offset + size * glm::vec3(unit(), unit(), unit()));
  return points;
}

/// Largest |x| or |y| in the picture (1: its edge), or infinity for a point behind the camera.
float reach(const Camera& camera, float aspect, const std::vector<glm::vec3>& points) {
  Camera fitted = camera;
  fitted.near = 0.001f;
  fitted.far = 1000;
  const glm::mat4 clip = clip_from_camera(fitted, aspect) * camera_from_world(fitted);
  float largest = 0;
  for (const glm::vec3& p : points) {
    const glm::vec4 q = clip * glm::vec4(p, 1);
    if (q.w <= 0) return INFINITY;
    largest = std::max({largest, std::abs(q.x / q.w), std::abs(q.y / q.w)});
  }
  return largest;
}

}  // namespace

TEST_CASE("framing shows all points and leaves exactly the margin on the tightest side") {
  for (std::uint32_t seed = 0; seed < 50; ++seed)
    for (const float aspect : {0.5f, 1.0f, 16.0f / 9}) {
      const std::vector<glm::vec3> points = random_points(seed, 40);
      for (const glm::vec3& direction : {default_view_direction(), glm::vec3(0, 1, 0), glm::vec3(-1, -0.2f, 0.3f)}) {
        const Camera camera = frame_points(points, 35, aspect, direction, 0.1f);
        CHECK(reach(camera, aspect, points) == doctest::Approx(0.9).epsilon(1e-3));
      }
    }
}

TEST_CASE("framing leaves the same margin on opposite sides, also along the axis that is not tight") {
  const auto sides = [](const Camera& camera, const std::vector<glm::vec3>& points) {
    Camera fitted = camera;
    fitted.near = 0.001f;
    fitted.far = 1000;
    const glm::mat4 clip = clip_from_camera(fitted, 16.0f / 9) * camera_from_world(fitted);
    glm::vec2 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : points) {
      const glm::vec4 q = clip * glm::vec4(p, 1);
      low = glm::min(low, glm::vec2(q) / q.w);
      high = glm::max(high, glm::vec2(q) / q.w);
    }
    return low + high;  // 0: symmetric
  };
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const std::vector<glm::vec3> points = random_points(seed, 30);
    const glm::vec2 off = sides(frame_points(points, 35, 16.0f / 9), points);
    CHECK(std::abs(off.x) < 1e-4f);
    CHECK(std::abs(off.y) < 1e-4f);
    const glm::vec3 axis = points.front();
    std::vector<glm::vec3> turned;
    const Camera camera = frame_turntable(points, axis, 35, 16.0f / 9);
    for (int angle = 0; angle < 360; ++angle)
      for (const glm::vec3& p : points) {
        const float c = std::cos(glm::radians(static_cast<float>(angle))),
                    s = std::sin(glm::radians(static_cast<float>(angle)));
        const glm::vec3 d = p - axis;
        turned.push_back(axis + glm::vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x));
      }
    // Of a circle one sees the extremes to within half a degree: a part 4e-5 of its radius.
    CHECK(std::abs(sides(camera, turned).y) < 2e-4f);
  }
}

TEST_CASE("turntable framing shows all points at every angle, and no closer camera would") {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const std::vector<glm::vec3> points = random_points(seed, 30);
    Bounds bounds;
    bounds.add(points);
    const glm::vec3 axis = bounds.centre();
    const float aspect = seed % 2 == 0 ? 16.0f / 9 : 0.6f;
    const Camera camera = frame_turntable(points, axis, 40, aspect, default_view_direction(), 0.05f);
    float widest = 0;
    for (int degree = 0; degree < 360; ++degree)
      widest = std::max(widest, reach(orbit(camera, axis, static_cast<float>(degree)), aspect, points));
    CHECK(widest < 0.951f);
    // A step of one degree misses the extreme by at most half a degree: 1 - cos(0.5 degrees) is far below 1 %.
    CHECK(widest > 0.94f);
  }
}

TEST_CASE("a point, nothing and a huge box can be framed") {
  const std::vector<glm::vec3> point{{3, 4, 5}};
  CHECK(reach(frame_points(point, 40, 1.5f), 1.5f, point) < 1e-3f);
  CHECK(std::isfinite(frame_points({}, 40, 1.5f).position.x));
  CHECK(std::isfinite(frame_bounds(Bounds{}, 40, 1.5f).position.x));
  const std::vector<glm::vec3> huge{{-1e6f, 0, 0}, {1e6f, 1e6f, 1e6f}};
  CHECK(std::isfinite(frame_points(huge, 40, 1.5f).position.x));
}

TEST_CASE("framing refuses what cannot be framed") {
  CHECK_THROWS_AS(frame_points({}, 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(frame_points({}, 180, 1), std::invalid_argument);
  CHECK_THROWS_AS(frame_points({}, 40, 0), std::invalid_argument);
  CHECK_THROWS_AS(frame_points({}, 40, NAN), std::invalid_argument);
  CHECK_THROWS_AS(frame_points({}, 40, 1, glm::vec3(0)), std::invalid_argument);
  CHECK_THROWS_AS(frame_points({}, 40, 1, {0, 0, 1}, 1), std::invalid_argument);
}

TEST_CASE("near and far enclose what is drawn, also around the camera") {
  Camera camera;
  camera.position = {0, 0, 10};
  camera.target = {0, 0, 0};
  const Camera fitted = fit_near_far(camera, {glm::vec3(-1), glm::vec3(1)});
  CHECK(fitted.near <= 9);
  CHECK(fitted.near > 8.5f);
  CHECK(fitted.far >= 11);
  const Camera inside = fit_near_far(camera, {glm::vec3(-20), glm::vec3(20)});
  CHECK(inside.near > 0);
  CHECK(inside.far >= 30);
}

TEST_CASE("a full turn about the axis leads back to the same picture") {
  const Camera camera;
  const Camera turned = orbit(camera, {1, 0, 2}, 360);
  CHECK(glm::length(turned.position - camera.position) < 1e-5f);
  const Camera quarter = orbit(camera, camera.target, 90);
  // Counter-clockwise seen from above: from +z towards +x.
  CHECK(quarter.position.x - camera.target.x == doctest::Approx(camera.position.z - camera.target.z));
}
