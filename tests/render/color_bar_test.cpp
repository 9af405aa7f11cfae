#include "render/color_bar.h"

#include <doctest/doctest.h>

#include <cmath>

#include "render/color_map.h"
#include "render/text.h"

using namespace softreel::render;

namespace {

Image plain(int width, int height) {
  Image image = Image::blank(width, height);
  for (std::uint8_t& byte : image.rgba) byte = 255;
  return image;
}

std::string joined(const Ticks& ticks) {
  std::string text;
  for (const std::string& label : ticks.labels) text += (text.empty() ? "" : " ") + label;
  return text + (ticks.factor.empty() ? "" : " " + ticks.factor);
}

}  // namespace

TEST_CASE("ticks are round numbers with the same digits") {
  CHECK(joined(nice_ticks(0, 1, 5)) == "0.0 0.2 0.4 0.6 0.8 1.0");
  CHECK(joined(nice_ticks(20, 273.4, 6)) == "50 100 150 200 250");
  CHECK(joined(nice_ticks(-0.0123, 0.0123, 5)) == "−0.010 −0.005 0.000 0.005 0.010");
  CHECK(joined(nice_ticks(0, 3.2e-6, 4)) == "0 1 2 3 ×10⁻⁶");
  CHECK(joined(nice_ticks(1e7, 3.5e7, 5)) == "1.0 1.5 2.0 2.5 3.0 3.5 ×10⁷");
  CHECK(nice_ticks(1, 1, 5).values.empty());
  for (int wanted = 2; wanted < 9; ++wanted)
    for (double high : {1.0, 1.7, 2.3, 4.9, 9.99, 123.0}) {
      const std::size_t n = nice_ticks(0, high, wanted).values.size();
      CHECK(n >= 2);
      CHECK(n <= static_cast<std::size_t>(wanted) + 1);
    }
}

TEST_CASE("the bar has the colour of each value where the ticks say it is, at any size") {
  for (const auto& [width, height] : {std::pair(640, 360), {1280, 720}, {1920, 1080}, {360, 640}}) {
    CAPTURE(width);
    Image image = plain(width, height);
    const ColorBar bars[] = {{color_map_index("viridis"), 0, 1, "u [m]"}, {color_map_index("coolwarm"), -3, 3, ""}};
    draw_color_bars(image, bars);
    const std::vector<BarPlace> places = color_bar_places(width, height, bars);
    REQUIRE(places.size() == 2);
    CHECK(places[1].right < places[0].left);
    for (std::size_t b = 0; b < 2; ++b) {
      const BarPlace& p = places[b];
      CHECK(p.left >= 0);
      CHECK(p.right < width);
      CHECK(p.bottom - p.top > 0.4 * height);
      for (int y = p.top; y < p.bottom; ++y) {
        const glm::vec3 color = color_at(color_maps()[bars[b].map], (static_cast<float>(p.bottom - y) - 0.5f) /
                                                                        static_cast<float>(p.bottom - p.top));
        const std::uint8_t* pixel = image.pixel((p.left + p.right) / 2, y);
        for (int c = 0; c < 3; ++c) CHECK(std::abs(pixel[c] - 255 * color[c]) <= 0.51f);
      }
    }
    CHECK(color_bars_width(width, height, bars) < 0.6 * width);
    CHECK(color_bars_width(width, height, {}) == 0);
  }
}

TEST_CASE("drawing a bar touches nothing left of it, and holds in a picture of one pixel") {
  Image image = plain(640, 360);
  const ColorBar bar[] = {{0, 0, 1, "a label of some length [m/s²]"}};
  draw_color_bars(image, bar);
  const int left = 640 - color_bars_width(640, 360, bar) - 1;
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < left; ++x) REQUIRE(image.pixel(x, y)[0] == 255);
  Image tiny = plain(1, 1);
  draw_color_bars(tiny, bar);
}

TEST_CASE("text is as wide as it says, and broken UTF-8 is drawn as something") {
  CHECK(text_width("", 20) == 0);
  CHECK(text_width("MM", 20) > 1.9f * text_width("M", 20));
  CHECK(text_width("°", 20) > 0);
  Image image = plain(80, 30);
  draw_text(image, "Ag\xff\xc3", 5, 20, 18, glm::vec3(0));
  int dark = 0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) dark += image.rgba[4 * i] < 64;
  CHECK(dark > 40);
  draw_text(image, "off the picture", -1000, 5000, 18, glm::vec3(0));
}
