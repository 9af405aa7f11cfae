// What the passes of a picture add up to: lens, shutter, lights with a size, and how many of them are enough.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "render/error_estimate.h"
#include "render/renderer.h"

using namespace softreel::render;

namespace {

RenderOptions options_of(int samples, int width = 96, int height = 96) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  return options;
}

Camera looking_down(float height) {
  Camera camera;
  camera.position = {0, height, 0};
  camera.target = {0, 0, 0};
  camera.up = {0, 0, -1};
  return camera;
}

/// Only what is covered matters.
Environment nothing() {
  Environment environment;
  environment.sky_shadow = false;
  return environment;
}

/// Width of the edge of what is drawn in the middle row [px]: from 10 % to 90 % cover.
int edge_width(const FloatImage& film) {
  int count = 0;
  for (int x = 0; x < film.width / 2; ++x) {
    const float alpha = film.rgba[static_cast<std::size_t>(film.height / 2 * film.width + x)].w;
    count += alpha > 0.1f && alpha < 0.9f;
  }
  return count;
}

double covered(const FloatImage& film) {
  double sum = 0;
  for (const glm::vec4& pixel : film.rgba) sum += pixel.w;
  return sum;
}

}  // namespace

TEST_CASE("what lies at the focus is as sharp through a lens as through a pinhole, what lies elsewhere is not") {
  // A plate at distance 4 covers 2 of 2 x 4 tan(20 deg) = 2.91 m: the lens of 0.4 m, focused at 8 m, blurs its edge
  // over 0.4 (8 - 4) / 8 = 0.2 m = 6.6 px, of which 10 % to 90 % of the disc's area lie within 69 % of its diameter.
  Renderer renderer(options_of(64));
  renderer.add_shape(make_box({2, 0.001f, 2}), Look{});
  Camera camera = looking_down(4);
  const int pinhole = edge_width(renderer.render_linear(camera, {}, nothing()));
  camera.aperture = 0.4f;
  CHECK(edge_width(renderer.render_linear(camera, {}, nothing())) <= pinhole + 1);
  camera.focus = 8;
  const int blurred = edge_width(renderer.render_linear(camera, {}, nothing()));
  CHECK(blurred >= pinhole + 2);
  CHECK(blurred <= 7);
}

TEST_CASE("an orthographic picture shows sizes that do not depend on the distance") {
  Renderer renderer(options_of(16, 120, 60));
  const MeshId box = renderer.add_shape(make_box({2, 0.001f, 1}), Look{});
  Camera camera = looking_down(5);
  camera.height = 3;  // 20 px per metre: 2 x 1 m are 40 x 20 px
  for (const float y : {0.0f, 2.0f, -3.0f}) {
    glm::mat4 moved(1);
    moved[3] = glm::vec4(0, y, 0, 1);
    renderer.set_transform(box, moved);
    CHECK(covered(renderer.render_linear(camera, {}, nothing())) == doctest::Approx(800).epsilon(0.01));
  }
  const Bounds bounds = renderer.bounds();
  const std::array<glm::vec3, 2> ends{bounds.low, bounds.high};
  // Seen from above, 2 m across fill 92 % of an aspect of 2.
  CHECK(frame_points_orthographic(ends, 2, {0, 1, 0}).height == doctest::Approx(1 / 0.92));
}

TEST_CASE("an open shutter smears what moves along its way and keeps its cover") {
  Renderer renderer(options_of(256));
  const MeshId box = renderer.add_shape(make_box({0.5f, 0.001f, 0.5f}), Look{});
  Camera camera = looking_down(5);
  camera.height = 2;  // 48 px per metre
  const auto at = [&](float x) {
    glm::mat4 moved(1);
    moved[3] = glm::vec4(x, 0, 0, 1);
    renderer.set_transform(box, moved);
    return camera;
  };
  const FloatImage film =
      renderer.render_linear(camera, {}, nothing(), [&](float time) { return at(time * 0.4f - 0.2f); });
  CHECK(covered(film) == doctest::Approx(24 * 24).epsilon(0.01));
  // The ramp of cover is 0.4 m long: a fifth of it away from each end lie 0.24 m = 11.5 px at 20 % to 80 %.
  int ramp = 0;
  for (int x = 0; x < 48; ++x) {
    const float alpha = film.rgba[static_cast<std::size_t>(48 * 96 + x)].w;
    ramp += alpha > 0.2f && alpha < 0.8f;
  }
  CHECK(ramp >= 11);
  CHECK(ramp <= 13);
  // Shut at once it is where it is at the end.
  Renderer once(options_of(1));
  const MeshId there = once.add_shape(make_box({0.5f, 0.001f, 0.5f}), Look{});
  float asked = -1;
  once.render_linear(camera, {}, nothing(), [&](float time) {
    asked = time;
    once.set_transform(there, glm::mat4(1));
    return camera;
  });
  CHECK(asked == 1);
}

TEST_CASE("a rectangle lights what it faces with the cosine at both ends, and nothing behind it") {
  // A small one over a matte plane: the irradiance from above falls with cos^4 of the angle (cos at both ends, distance
  // squared).
  Renderer renderer(options_of(16));
  Environment environment = nothing();
  environment.sky = environment.ground_light = glm::vec3(0);
  environment.ground.visible = true;
  environment.ground.fade_begin = 100;
  environment.ground.fade_end = 200;
  environment.ground.look.color = glm::vec3(0.5f);
  const Light light = rectangle_light({0, 2, 0}, {0, 0, 0}, {0.01f, 0.01f});
  Camera camera = looking_down(10);
  camera.height = 8;  // 12 px per metre
  const FloatImage film = renderer.render_linear(camera, {&light, 1}, environment);
  for (const int metres : {0, 1, 2, 3}) {
    const double cosine = 2 / std::hypot(2.0, metres);
    const double shown = film.rgba[static_cast<std::size_t>(48 * 96 + 48 + 12 * metres)].y;
    CHECK(shown == doctest::Approx(0.5 * std::pow(cosine, 4)).epsilon(0.03));
  }
  Light away = light;
  away.direction = -away.direction;
  CHECK(renderer.render_linear(camera, {&away, 1}, environment).rgba[48 * 96 + 48].y == 0);
}

TEST_CASE("a tolerance takes as many passes as it needs, and the estimate is not below the true error") {
  const auto scene = [](Renderer& renderer) {
    renderer.add_shape(make_sphere(0.5f), Look{});
    Environment environment = nothing();
    environment.ground.visible = true;
    environment.ground.height = -0.5f;
    Camera camera;
    camera.position = {1, 2, 3};
    camera.target = {0, 0, 0};
    camera.aperture = 0.2f;
    const Light light = area_light({2, 3, 1}, {0, 0, 0}, 0.8f);
    return renderer.render_linear(camera, {&light, 1}, environment);
  };
  Renderer fine(options_of(512, 48, 48));
  const FloatImage reference = scene(fine);
  CHECK(!fine.last_picture().error);
  int before = 0;
  for (const double tolerance : {4.0, 1.0}) {
    RenderOptions options = options_of(256, 48, 48);
    options.tolerance = tolerance;
    Renderer renderer(options);
    const FloatImage picture = scene(renderer);
    const PictureReport& report = renderer.last_picture();
    REQUIRE(report.error);
    CHECK(*report.error <= tolerance);
    CHECK(report.samples < 256);
    CHECK(report.samples > before);
    before = report.samples;
    const double error = shown_difference(picture, reference, nothing());
    CHECK(error <= *report.error);
    // and not so far above that passes are wasted without end: four times the error are up to sixteen times the passes
    CHECK(error > 0.25 * *report.error);
  }
  RenderOptions hopeless = options_of(16, 48, 48);
  hopeless.tolerance = 1e-6;
  Renderer renderer(hopeless);
  scene(renderer);
  CHECK(renderer.last_picture().samples == 16);
  CHECK(*renderer.last_picture().error > 1e-6);
}
