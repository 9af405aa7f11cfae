#include <doctest/doctest.h>

#include <cmath>

#include "render/environment.h"
#include "render/film.h"
#include "render/look.h"

using namespace softreel::render;

TEST_CASE("sRGB bytes are the nearest ones for every linear value") {
  const auto encode = [](double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; };
  int wrong = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const float linear = static_cast<float>(i) / 1000000;
    const double exact = 255 * encode(linear);
    if (std::abs(srgb_byte(linear) - exact) > 0.5 + 1e-4) ++wrong;
  }
  CHECK(wrong == 0);
  CHECK(srgb_byte(-1) == 0);
  CHECK(srgb_byte(NAN) == 0);
  CHECK(srgb_byte(7) == 255);
  CHECK(srgb_byte(INFINITY) == 255);
  for (unsigned byte = 0; byte < 256; ++byte) CHECK(srgb_byte(linear_from_hex(byte).z) == byte);
}

TEST_CASE("the tone curve is monotonous, stays in range and keeps middle tones") {
  float before = -1;
  for (int i = 0; i < 4000; ++i) {
    const float grey = static_cast<float>(i) * 0.01f;
    const glm::vec3 tone = tone_curve(glm::vec3(grey));
    CHECK(tone.x >= before);
    CHECK(tone.x <= 1);
    before = tone.x;
  }
  // Below the shoulder only the offset of 0.04 is taken away: hue differences stay.
  const glm::vec3 color = tone_curve({0.5f, 0.3f, 0.2f});
  CHECK(color.x - color.y == doctest::Approx(0.2f));
  CHECK(color.y == doctest::Approx(0.26f));
}

TEST_CASE("the background reaches the file as it was asked for") {
  FloatImage film{4, 3, std::vector<glm::vec4>(12, glm::vec4(0))};
  Environment environment;
  environment.background_top = environment.background_bottom = linear_from_hex(0x336699);
  environment.exposure = 3;
  const Image image = develop(film, environment);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) {
      CHECK(int{image.pixel(x, y)[0]} == 0x33);
      CHECK(int{image.pixel(x, y)[1]} == 0x66);
      CHECK(int{image.pixel(x, y)[2]} == 0x99);
      CHECK(int{image.pixel(x, y)[3]} == 255);
    }
  environment.transparent = true;
  CHECK(develop(film, environment) == Image::blank(4, 3));
}

TEST_CASE("half covered pixels are half surface, half background") {
  FloatImage film{1, 1, {glm::vec4(0.15f, 0.15f, 0.15f, 0.5f)}};
  Environment environment;
  environment.background_top = environment.background_bottom = glm::vec3(1);
  // Radiance 0.3 of the covered half, through the tone curve 0.26.
  CHECK(int{develop(film, environment).pixel(0, 0)[1]} == int{srgb_byte(0.5f * 0.26f + 0.5f)});
  environment.transparent = true;
  CHECK(int{develop(film, environment).pixel(0, 0)[3]} == 128);
  CHECK(int{develop(film, environment).pixel(0, 0)[1]} == int{srgb_byte(0.26f)});
}
