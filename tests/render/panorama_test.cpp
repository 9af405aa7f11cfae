#include "render/panorama.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "render/error.h"
#include "render/renderer.h"
#include "tests/render/scratch_folder.h"

using namespace softreel::render;

namespace {

HdrImage even(const glm::vec3& color, int width = 64) {
  return {width, width / 2, std::vector<glm::vec3>(static_cast<std::size_t>(width * width / 2), color), 0};
}

/// Sum of the harmonics at n, as shader_sky.cpp evaluates it.
glm::vec3 irradiance(const Panorama& p, const glm::vec3& n) {
  const auto& c = p.irradiance();
  return 0.282095f * c[0] + 0.488603f * (n.y * c[1] + n.z * c[2] + n.x * c[3]) +
         1.092548f * (n.x * n.y * c[4] + n.y * n.z * c[5] + n.x * n.z * c[7]) + 0.315392f * (3 * n.z * n.z - 1) * c[6] +
         0.546274f * (n.x * n.x - n.y * n.y) * c[8];
}

}  // namespace

TEST_CASE("even light from everywhere shows a white matte surface at its own radiance, and in every mirror") {
  const Panorama panorama(even({1, 0.5f, 0.25f}), 2, 30);
  for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::normalize(glm::vec3(-1, -2, 3))}) {
    const glm::vec3 e = irradiance(panorama, n);
    CHECK(e.x == doctest::Approx(2).epsilon(1e-3));
    CHECK(e.z == doctest::Approx(0.5).epsilon(1e-3));
  }
  for (const Panorama::Level& level : panorama.levels())
    for (const glm::vec4& texel : level.texels) CHECK(texel.y == doctest::Approx(1).epsilon(1e-4));
  CHECK(!panorama.sun());
}

TEST_CASE("the mean over sampled directions is the light on a surface") {
  HdrImage image = even({0.2f, 0.2f, 0.2f}, 128);
  for (int y = 8; y < 24; ++y)
    for (int x = 30; x < 60; ++x) image.pixels[static_cast<std::size_t>(y * 128 + x)] = {2, 1.5f, 1};
  const Panorama panorama(image, 1, 0);
  const glm::vec3 n = glm::normalize(glm::vec3(0.2f, 1, 0.1f));
  glm::dvec3 sum(0);
  constexpr int kSide = 64;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Panorama::Sample s = panorama.sample(
        {(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide});
    sum += glm::dvec3(s.part) * static_cast<double>(std::max(glm::dot(s.towards, n), 0.0f));
  }
  const glm::vec3 expected = irradiance(panorama, n);
  // Harmonics of order 2 hold 99 % of the energy of irradiance, 3 % at most are missing in a direction (Ramamoorthi and
  // Hanrahan 2001, section 3).
  for (int c = 0; c < 3; ++c) CHECK(sum[c] / (kSide * kSide) == doctest::Approx(expected[c]).epsilon(0.04));
}

TEST_CASE("a sun in the picture becomes a light with its direction, size and strength") {
  HdrImage image = even({0.3f, 0.4f, 0.5f}, 256);
  // One pixel of 1.4 degrees at longitude 90 (+x), 45 degrees high.
  image.pixels[32 * 256 + 192] = {5000, 4500, 4000};
  const Panorama panorama(image, 1, 0);
  REQUIRE(panorama.sun());
  const Light& sun = *panorama.sun();
  CHECK(-sun.direction.x == doctest::Approx(std::numbers::sqrt2 / 2).epsilon(0.02));
  CHECK(-sun.direction.y == doctest::Approx(std::numbers::sqrt2 / 2).epsilon(0.02));
  CHECK(sun.angular_diameter < 3);
  const double angle = std::pow(std::numbers::pi / 128, 2) * std::sin(std::numbers::pi / 4);
  CHECK(sun.intensity == doctest::Approx(5000 * angle / std::numbers::pi).epsilon(0.02));
}

TEST_CASE("a white ball in even light vanishes before it") {
  RenderOptions options;
  options.width = options.height = 48;
  options.samples = 64;
  Renderer renderer(options);
  Look white;
  white.color = glm::vec3(1);
  white.roughness = 1;
  renderer.add_shape(make_sphere(0.5f), white);
  Environment environment;
  environment.panorama = std::make_shared<Panorama>(even(glm::vec3(0.5f)), 1.0f, 0.0f);
  environment.panorama_behind = true;
  Camera camera;
  camera.position = {0, 0, 3};
  camera.target = {0, 0, 0};
  const FloatImage film = renderer.render_linear(camera, {}, environment);
  // The furnace test: what the specular lobe takes the diffuse one gives; the fit of the split sum is good to 3 %.
  for (const glm::vec4& p : film.rgba) CHECK(p.y == doctest::Approx(0.5).epsilon(0.03));
}

TEST_CASE("a broken or bent HDR file is answered with an error or mended, never with light that is not finite") {
  const softreel::render::test::ScratchFolder folder;
  std::string good = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
  for (int i = 0; i < 32; ++i) good += std::string("\x80\x40\x20\x81", 4);
  const auto write = [&](const char* name, const std::string& text) {
    softreel::render::test::write_bytes(folder / name, std::vector<unsigned char>(text.begin(), text.end()));
    return folder / name;
  };
  const HdrImage image = load_hdr(write("good.hdr", good));
  CHECK(image.width == 8);
  CHECK(image.pixels[5].x == doctest::Approx(1));
  CHECK(image.pixels[5].z == doctest::Approx(0.25));
  // The largest exponent there is: far beyond what sums can hold.
  std::string bright = good;
  for (std::size_t i = bright.size() - 1; i + 128 > bright.size(); i -= 4) bright[i] = static_cast<char>(0xff);
  const HdrImage capped = load_hdr(write("bright.hdr", bright));
  CHECK(image.mended == 0);
  CHECK(capped.mended == 32);
  const Panorama panorama(capped, 1, 0);
  for (const glm::vec3& c : panorama.irradiance()) CHECK(std::isfinite(c.x + c.y + c.z));
  CHECK_THROWS_AS(load_hdr(write("cut.hdr", good.substr(0, 40))), RenderError);
  CHECK_THROWS_AS(load_hdr(write("none.hdr", "no picture")), RenderError);
  CHECK_THROWS_AS(load_hdr(folder / "missing.hdr"), RenderError);
}
