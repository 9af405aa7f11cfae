#include "render/renderer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace softreel::render;

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

RenderOptions small(int samples, int width = 96, int height = 64) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  return options;
}

Environment dark() {
  Environment environment;
  environment.sky = environment.ground_light = glm::vec3(0);
  return environment;
}

Environment dark_with_ground(float albedo) {
  Environment environment = dark();
  environment.ground.visible = true;
  environment.ground.fade_begin = 100;
  environment.ground.fade_end = 200;
  environment.ground.look.color = glm::vec3(albedo);
  return environment;
}

Camera from_above(float height) {
  Camera camera;
  camera.position = {0, height, 0};
  camera.target = {0, 0, 0};
  camera.up = {0, 0, -1};
  return camera;
}

const glm::vec4& middle(const FloatImage& film) {
  return film.rgba[static_cast<std::size_t>(film.height / 2 * film.width + film.width / 2)];
}

double rms(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const glm::dvec4 d = glm::dvec4(a.rgba[i]) - glm::dvec4(b.rgba[i]);
    sum += glm::dot(d, d);
  }
  return std::sqrt(sum / static_cast<double>(a.rgba.size()));
}

void add_ball(Renderer& renderer, const glm::vec3& place, float radius = 0.5f, const Look& look = {}) {
  glm::mat4 world_from_mesh(1);
  world_from_mesh[3] = glm::vec4(place, 1);
  renderer.set_transform(renderer.add_shape(make_sphere(radius), look), world_from_mesh);
}

}  // namespace

TEST_CASE("a matte plane under a sun reflects albedo x intensity x cosine") {
  Renderer renderer(small(1));
  for (const float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
    const float angle = glm::radians(degrees);
    Light sun = sun_light({std::sin(angle), -std::cos(angle), 0}, 0.5f, 2);
    const glm::vec4 pixel = middle(renderer.render_linear(from_above(5), {&sun, 1}, dark_with_ground(0.25f)));
    // The stored colour has 10 bits or more as a square root: 2 / 1023 of its value at most, and half a step of
    // rounding.
    CHECK(pixel.y == doctest::Approx(0.25 * 2 * std::cos(angle)).epsilon(0.003));
    CHECK(pixel.w == 1);
  }
}

TEST_CASE("the light of a sphere falls with the distance squared, from its reference distance on") {
  Renderer renderer(small(1, 65, 65));
  for (const float height : {1.0f, 2.0f, 4.0f}) {
    Light lamp = area_light({0, height, 0}, {0, height - 2, 0}, 0.01f, 1.5f);
    const glm::vec4 pixel = middle(renderer.render_linear(from_above(5), {&lamp, 1}, dark_with_ground(0.25f)));
    CHECK(pixel.y == doctest::Approx(0.25 * 1.5 * 4 / (height * height)).epsilon(0.003));
  }
}

TEST_CASE("the matte part of a surface follows the cosine law") {
  // White minus black leaves the diffuse part; its factor depends on the view only, which stays.
  const auto diffuse_at = [](float degrees) {
    std::array<float, 2> radiance{};
    for (std::size_t white = 0; white < 2; ++white) {
      Renderer renderer(small(1));
      Look look;
      look.color = glm::vec3(static_cast<float>(white));
      look.roughness = 1;
      renderer.add_shape(make_plane(4, 4), look);
      const float angle = glm::radians(degrees);
      Light sun = sun_light({std::sin(angle), -std::cos(angle), 0}, 0.5f, 1);
      radiance[white] = middle(renderer.render_linear(from_above(5), {&sun, 1}, dark())).y;
    }
    return radiance[1] - radiance[0];
  };
  const float straight = diffuse_at(0);
  CHECK(straight > 0.85f);
  CHECK(straight < 1);
  for (const float degrees : {30.0f, 60.0f})
    CHECK(diffuse_at(degrees) / straight == doctest::Approx(std::cos(glm::radians(degrees))).epsilon(0.01));
}

TEST_CASE("in a white furnace a rough white ball disappears, metal or not") {
  Environment furnace = dark();
  furnace.sky = furnace.ground_light = glm::vec3(0.5f);
  for (const float metallic : {0.0f, 1.0f}) {
    Renderer renderer(small(1));
    Look look;
    look.color = glm::vec3(1);
    look.roughness = 1;
    look.metallic = metallic;
    add_ball(renderer, {0, 0, 0}, 1, look);
    const FloatImage film = renderer.render_linear(frame_bounds(renderer.bounds(), 40, 1.5f), {}, furnace);
    std::size_t covered = 0;
    for (const glm::vec4& pixel : film.rgba)
      if (pixel.w > 0) {
        ++covered;
        CHECK(pixel.y == doctest::Approx(0.5).epsilon(1e-3));
      }
    CHECK(covered > 1000);
  }
}

TEST_CASE("a shadow falls where the light is blocked, and only there") {
  Renderer renderer(small(1, 128, 128));
  add_ball(renderer, {0, 1, 0}, 0.5f);
  // From above left: the shadow's middle lies one metre to the right of the ball's foot.
  Light sun = sun_light({1, -1, 0}, 0.1f, 1);
  Camera camera = from_above(4);
  camera.near = 3;  // looks past the ball: nearer than 3 m is not drawn
  camera.far = 10;
  const FloatImage film = renderer.render_linear(camera, {&sun, 1}, dark_with_ground(0.5f));
  const float half = 4 * std::tan(glm::radians(20.0f));
  int wrong = 0;
  int dark_pixels = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const float world_x = ((static_cast<float>(x) + 0.5f) / 64 - 1) * half;
      const float world_z = ((static_cast<float>(y) + 0.5f) / 64 - 1) * half;
      // Distance of the ground point from the ray through the ball's centre, against its radius.
      const glm::vec3 way = glm::vec3(world_x, 0, world_z) - glm::vec3(0, 1, 0);
      const glm::vec3 along = glm::normalize(glm::vec3(1, -1, 0));
      const float distance = glm::length(way - glm::dot(way, along) * along);
      const float radiance = film.rgba[static_cast<std::size_t>(128 * y + x)].y;
      const float lit = 0.5f * std::sqrt(0.5f);
      if (distance < 0.47f) {
        ++dark_pixels;
        if (radiance > 0.01f * lit) ++wrong;
      }
      if (distance > 0.53f && radiance < 0.99f * lit) ++wrong;
    }
  CHECK(dark_pixels > 1000);
  CHECK(wrong == 0);
}

TEST_CASE("nothing shades itself under a high light: no acne, no leaks") {
  Renderer renderer(small(4, 160, 120));
  add_ball(renderer, {0, 1, 0}, 1);
  Light lamp = area_light({0, 6, 0.01f}, {0, 1, 0}, 0.5f, 1);
  Light without = lamp;
  without.casts_shadow = false;
  const Camera camera = from_above(5);
  const FloatImage shadowed = renderer.render_linear(camera, {&lamp, 1}, dark());
  const FloatImage plain = renderer.render_linear(camera, {&without, 1}, dark());
  // Seen from the light a convex body hides nothing of itself.
  for (std::size_t i = 0; i < plain.rgba.size(); ++i)
    CHECK(shadowed.rgba[i].y == doctest::Approx(plain.rgba[i].y).epsilon(0.02));
}

TEST_CASE("the penumbra of an edge has the closed form of a half hidden disc") {
  // Light: disc of radius R at height H. Edge at height h over x = 0, blocking x < 0. From ground point x the edge is
  // seen at x (1 - H / h) on the disc; what lies beyond is a circular segment.
  constexpr float kRadius = 0.4f;
  constexpr float kLight = 4;
  constexpr float kEdge = 1;
  Renderer renderer(small(64, 128, 16));
  Look look;
  look.two_sided = true;
  Shape blocker = make_plane(3, 6);
  for (glm::vec3& p : blocker.positions) p += glm::vec3(-1.5f, kEdge, 0);
  renderer.add_shape(blocker, look);
  Light lamp = area_light({0, kLight, 0}, {0, 0, 0}, kRadius, 1);
  Light without = lamp;
  without.casts_shadow = false;
  Camera camera = from_above(3);
  camera.fov = 5;
  camera.near = 2.5f;
  camera.far = 4;
  const Environment environment = dark_with_ground(0.5f);
  const FloatImage shadowed = renderer.render_linear(camera, {&lamp, 1}, environment);
  const FloatImage plain = renderer.render_linear(camera, {&without, 1}, environment);
  const float half = 3 * std::tan(glm::radians(2.5f)) * 8;
  double worst = 0;
  for (int pixel = 0; pixel < 128; ++pixel) {
    const float x = ((static_cast<float>(pixel) + 0.5f) / 64 - 1) * half;
    const float t = std::clamp(x * (1 - kLight / kEdge) / kRadius, -1.0f, 1.0f);
    const double visible = (std::acos(t) - t * std::sqrt(1 - t * t)) / kPi;
    const std::size_t at = static_cast<std::size_t>(8 * 128 + pixel);
    worst = std::max(worst, std::abs(shadowed.rgba[at].y / plain.rgba[at].y - visible));
  }
  // 64 stratified points measure the segment to about N^-3/4 = 4.4 %; facing the middle of the casters, the disc is
  // tilted by some 20 degrees, which narrows it by at most 7 %, a change of visible below 3 %.
  CHECK(worst < 0.07);
}

TEST_CASE("more passes come closer to the limit") {
  std::vector<FloatImage> films;
  for (const int samples : {1, 4, 16, 64, 512}) {
    Renderer renderer(small(samples));
    add_ball(renderer, {0, 0.5f, 0});
    const Camera camera = frame_bounds({glm::vec3(-1, 0, -1), glm::vec3(1)}, 40, 1.5f);
    Stage stage = default_stage(renderer.bounds(), camera, true);
    films.push_back(renderer.render_linear(camera, stage.lights, stage.environment));
  }
  std::vector<double> error;
  for (std::size_t i = 0; i + 1 < films.size(); ++i) error.push_back(rms(films[i], films.back()));
  // Random points halve the error with four times as many; stratified ones do better than that over the whole range.
  for (std::size_t i = 1; i < error.size(); ++i) CHECK(error[i] < 0.75 * error[i - 1]);
  CHECK(error[3] < error[0] / 8);
}

TEST_CASE("a feature costs nothing where it is not used") {
  const Camera camera;
  Light lamp = area_light({3, 5, 2}, {0, 0, 0}, 0.5f);
  SUBCASE("one sample: no accumulation buffer") {
    Renderer renderer(small(1));
    add_ball(renderer, {0, 0, 0});
    renderer.render(camera, {&lamp, 1}, {});
    CHECK(renderer.counters().accumulation_buffers == 0);
    CHECK(renderer.counters().passes == 1);
    CHECK(renderer.counters().shadow_passes == 1);
    CHECK(renderer.counters().textures == 0);
  }
  SUBCASE("several samples: one accumulation buffer for all frames") {
    Renderer renderer(small(3));
    add_ball(renderer, {0, 0, 0});
    renderer.render(camera, {&lamp, 1}, {});
    renderer.render_linear(camera, {&lamp, 1}, {});
    CHECK(renderer.counters().accumulation_buffers == 1);
    CHECK(renderer.counters().passes == 6);
    CHECK(renderer.counters().shadow_maps == 1);
    CHECK(renderer.counters().shadow_passes == 6);
  }
  SUBCASE("no light with shadows, or nothing that casts: no shadow map") {
    Renderer renderer(small(2));
    lamp.casts_shadow = false;
    add_ball(renderer, {0, 0, 0});
    renderer.render(camera, {&lamp, 1}, {});
    lamp.casts_shadow = true;
    renderer.set_casts_shadow(0, false);
    renderer.render(camera, {&lamp, 1}, {});
    lamp.intensity = 0;
    renderer.set_casts_shadow(0, true);
    renderer.render(camera, {&lamp, 1}, {});
    CHECK(renderer.counters().shadow_maps == 0);
    CHECK(renderer.counters().shadow_passes == 0);
  }
  SUBCASE("a mesh that keeps its shape: one upload, however it moves") {
    Renderer renderer(small(2));
    add_ball(renderer, {0, 0, 0});
    const Shape ball = make_sphere(0.5f);
    for (int frame = 0; frame < 3; ++frame) {
      renderer.set_positions(0, ball.positions);
      glm::mat4 world_from_mesh(1);
      world_from_mesh[3].x = static_cast<float>(frame);
      renderer.set_transform(0, world_from_mesh);
      renderer.render(camera, {&lamp, 1}, {});
    }
    CHECK(renderer.counters().mesh_uploads == 1);
  }
}

TEST_CASE("only the front of a surface is drawn unless it has two sides, and the back has its own colour") {
  Look look;
  look.color = {1, 0, 0};
  const auto seen = [&](float camera_height, float mirror) {
    Renderer renderer(small(1));
    const MeshId plane = renderer.add_shape(make_plane(4, 4), look);
    glm::mat4 world_from_mesh(1);
    world_from_mesh[0][0] = mirror;
    renderer.set_transform(plane, world_from_mesh);
    Environment environment;
    return middle(renderer.render_linear(from_above(camera_height), {}, environment));
  };
  CHECK(seen(3, 1).w == 1);
  CHECK(seen(-3, 1).w == 0);
  CHECK(seen(3, -1).w == 1);
  look.two_sided = true;
  look.back_color = glm::vec3(0, 0, 1);
  CHECK(seen(3, 1).x > 2 * seen(3, 1).z);
  CHECK(seen(-3, 1).z > 2 * seen(-3, 1).x);
}

TEST_CASE("a texture lies the right way up") {
  auto image = std::make_shared<Image>(Image::blank(2, 64));
  image->rgba.assign(image->rgba.size(), 255);
  for (int y = 0; y < 64; ++y)  // upper half red, lower half blue
    for (int x = 0; x < 2; ++x) image->pixel(x, y)[y < 32 ? 2 : 0] = image->pixel(x, y)[1] = 0;
  Look look;
  look.color = glm::vec3(1);
  look.texture = image;
  Renderer renderer(small(1, 64, 64));
  renderer.add_shape(make_plane(2, 2), look);
  const FloatImage film = renderer.render_linear(from_above(3), {}, {});
  // v = 1 is at -z, which is up in this view.
  const glm::vec4 upper = film.rgba[64 * 22 + 32];
  const glm::vec4 lower = film.rgba[64 * 42 + 32];
  CHECK(upper.x > 3 * upper.z);
  CHECK(lower.z > 3 * lower.x);
  CHECK(renderer.counters().textures == 1);
}

TEST_CASE("the ground fades into the background and its horizon is not seen") {
  Renderer renderer(small(1, 64, 64));
  Environment environment;
  environment.ground.visible = true;
  environment.ground.fade_begin = 2;
  environment.ground.fade_end = 20;
  Camera camera;
  camera.position = {0, 1.5f, 3};
  camera.target = {0, 1, 0};
  const FloatImage film = renderer.render_linear(camera, {}, environment);
  CHECK(film.rgba[64 * 63 + 32].w > 0.95f);
  CHECK(film.rgba[64 * 5 + 32].w == 0);
  for (std::size_t y = 1; y < 64; ++y) {
    const float step = film.rgba[64 * y + 32].w - film.rgba[64 * (y - 1) + 32].w;
    CHECK(step >= 0);
    CHECK(step < 0.25f);
  }
}

TEST_CASE("options, lights and positions that make no sense are refused") {
  CHECK_THROWS_AS(Renderer(small(0)), std::invalid_argument);
  CHECK_THROWS_AS(Renderer(small(1, 0, 5)), std::invalid_argument);
  CHECK_THROWS_AS(Renderer(small(1, 100000, 5)), std::invalid_argument);
  Renderer renderer(small(1));
  add_ball(renderer, {0, 0, 0});
  CHECK_THROWS_AS(renderer.set_positions(0, std::vector<glm::vec3>(3)), std::invalid_argument);
  CHECK_THROWS_AS(renderer.set_visible(7, false), std::invalid_argument);
  Light bad;
  bad.radius = NAN;
  CHECK_THROWS_AS(renderer.render({}, {&bad, 1}, {}), std::invalid_argument);
  const std::vector<Light> many(100);
  CHECK_THROWS_AS(renderer.render({}, many, {}), std::invalid_argument);
}

TEST_CASE("two renderers can be used in turns") {
  Renderer a(small(2));
  Renderer b(small(1, 48, 48));
  add_ball(a, {0, 0, 0});
  add_ball(b, {0, 0, 0});
  const Image first = a.render({}, {}, {});
  b.render({}, {}, {});
  add_ball(b, {1, 0, 0});
  CHECK(a.render({}, {}, {}) == first);
}
