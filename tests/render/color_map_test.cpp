#include "render/color_map.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "render/film.h"
#include "render/renderer.h"

using namespace softreel::render;

namespace {

constexpr int kSide = 256;

int distance(const std::uint8_t* pixel, const glm::vec3& srgb) {
  int most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(pixel[c] - static_cast<int>(std::lround(255 * srgb[c]))));
  return most;
}

/// A square of 1 m seen from above, fills the picture; its value runs from 0 at the left edge to 1 at the right.
Image ramp(const char* map, float exposure, float shading, bool lit) {
  Renderer renderer({.width = kSide, .height = kSide, .samples = 2});
  Shape plane = make_plane(1, 1);
  Look look;
  look.two_sided = true;
  look.color_map = color_map_index(map);
  look.shading = shading;
  std::vector<float> values;
  for (const glm::vec3& p : plane.positions) values.push_back(p.x + 0.5f);
  const MeshId mesh = renderer.add_shape(std::move(plane), look);
  renderer.set_values(mesh, values);
  Camera camera;
  camera.position = {0, 1, 0};
  camera.target = {0, 0, 0};
  camera.up = {0, 0, -1};
  camera.fov = 2 * glm::degrees(std::atan(0.5f));
  Environment environment;
  environment.exposure = exposure;
  if (!lit) environment.sky = environment.ground_light = glm::vec3(0);
  return renderer.render(camera, {}, environment);
}

}  // namespace

TEST_CASE("a colour map has its anchors' colours at their places, and the ends beyond") {
  for (const ColorMap& map : color_maps()) {
    CAPTURE(map.name);
    const auto last = static_cast<float>(map.anchors.size() - 1);
    for (std::size_t i = 0; i < map.anchors.size(); ++i) {
      const std::uint32_t hex = map.anchors[i];
      const glm::vec3 color = color_at(map, static_cast<float>(i) / last);
      CHECK(color.x * 255 == doctest::Approx(hex >> 16).epsilon(1e-4));
      CHECK(color.y * 255 == doctest::Approx((hex >> 8) & 255u).epsilon(1e-4));
      CHECK(color.z * 255 == doctest::Approx(hex & 255u).epsilon(1e-4));
    }
    CHECK(color_at(map, -3) == color_at(map, 0));
    CHECK(color_at(map, 3) == color_at(map, 1));
    CHECK(color_at(map, std::numeric_limits<float>::quiet_NaN()) == glm::vec3(0.5f));
    CHECK(&color_maps()[color_map_index(map.name)] == &map);
  }
  CHECK_THROWS_AS(color_map_index("jet"), std::invalid_argument);
}

TEST_CASE("the sequential maps grow steadily brighter, and coolwarm is brightest in its middle") {
  const auto luminance = [](const ColorMap& map, float t) {
    return glm::dot(linear_from_srgb(color_at(map, t)), glm::vec3(0.2126f, 0.7152f, 0.0722f));
  };
  for (const ColorMap& map : color_maps()) {
    CAPTURE(map.name);
    for (int i = 0; i < 64; ++i) {
      const float a = luminance(map, static_cast<float>(i) / 64), b = luminance(map, static_cast<float>(i + 1) / 64);
      if (map.name == "coolwarm")
        CHECK((i < 32 ? b > a : b < a));
      else
        CHECK(b > a);
    }
  }
}

TEST_CASE("what the shader looks up is within one level of the map") {
  const auto texels = color_map_texels();
  for (std::size_t row = 0; row < color_maps().size(); ++row)
    for (int i = 0; i <= 5000; ++i) {
      const float t = static_cast<float>(i) / 5000;
      const auto nearest = static_cast<std::size_t>(t * (kColorMapTexels - 1) + 0.5f);
      const glm::vec4& texel = texels[row * kColorMapTexels + nearest];
      const glm::vec3 exact = color_at(color_maps()[row], t);
      for (int c = 0; c < 3; ++c) CHECK(std::abs(srgb_byte(texel[c]) - 255 * exact[c]) < 1.01f);
    }
}

TEST_CASE("a field has the very colours of its map in the picture, whatever light and exposure") {
  for (const ColorMap& map : color_maps()) {
    CAPTURE(map.name);
    const Image picture = ramp(map.name.data(), 1, 0, true);
    for (int x = 2; x < kSide - 2; ++x)
      // Two sub-pixel offsets stand for the pixel: a quarter of one, in which no map runs over more than a level, and
      // one for the texel and for rounding.
      CHECK(distance(picture.pixel(x, kSide / 2), color_at(map, (static_cast<float>(x) + 0.5f) / kSide)) <= 2);
    CHECK(ramp(map.name.data(), 8, 0, true) == picture);
    CHECK(ramp(map.name.data(), 1, 0, false) == picture);
  }
}

TEST_CASE("shading darkens a field where light is missing, and never brightens it") {
  const Image flat = ramp("viridis", 1, 0, true), dark = ramp("viridis", 1, 1, false),
              half = ramp("viridis", 1, 0.5f, true);
  for (int x = 2; x < kSide - 2; ++x)
    for (int c = 0; c < 3; ++c) {
      CHECK(dark.pixel(x, kSide / 2)[c] == 0);
      CHECK(half.pixel(x, kSide / 2)[c] <= flat.pixel(x, kSide / 2)[c]);
    }
  CHECK(half != flat);
}

TEST_CASE("a mesh without a colour map takes no values, and a picture without a field has no second layer") {
  Renderer renderer({.width = 16, .height = 16, .samples = 1});
  const MeshId mesh = renderer.add_shape(make_plane(1, 1), {});
  const std::vector<float> four(4, 0.5f);
  CHECK_THROWS_AS(renderer.set_values(mesh, four), std::invalid_argument);
  CHECK(renderer.render_linear({}, {}, {}).display.empty());
  Look field;
  field.color_map = 0;
  const MeshId other = renderer.add_shape(make_plane(1, 1), field);
  CHECK_THROWS_AS(renderer.set_values(other, std::vector<float>(3, 0.0f)), std::invalid_argument);
  CHECK_NOTHROW(renderer.set_values(other, four));
  CHECK(renderer.render_linear({}, {}, {}).display.size() == 256);
  field.color_map = 99;
  CHECK_THROWS_AS(renderer.add_shape(make_plane(1, 1), field), std::invalid_argument);
}
