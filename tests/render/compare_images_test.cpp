#include <doctest/doctest.h>

#include "render/compare_images.h"
#include "render/difference_picture.h"
#include "render/tolerance.h"

using namespace softreel::render;

namespace {

Image grey(int width = 100, int height = 50) {
  Image image = Image::blank(width, height);
  image.rgba.assign(image.rgba.size(), 100);
  return image;
}

/// `levels` more in one channel of the first `count` pixels.
Image changed(std::size_t count, int levels, int channel = 1) {
  Image image = grey();
  for (std::size_t i = 0; i < count; ++i)
    image.rgba[4 * i + static_cast<std::size_t>(channel)] = static_cast<std::uint8_t>(100 + levels);
  return image;
}

Judgement judged(const Image& a, const Image& b, const Tolerance& tolerance = {}) {
  const ImageDifference d = compare(a, b);
  if (tolerance.rung < Rung::kPerceptual || !d.same_size) return judge(d, false, nullptr, tolerance);
  const FlipFigures f = figures_of(flip(a, b));
  return judge(d, false, &f, tolerance);
}

bool says(const Judgement& j, const char* part) { return j.limit.find(part) != std::string::npos; }

}  // namespace

TEST_CASE(
    "the judgement climbs from same pixels over driver to different exactly at the limits, and says which decided") {
  // 5000 pixels: 0.1 % are 5.
  CHECK(judged(grey(), grey()).reached == Rung::kPixels);
  for (const int levels : {1, 3, -3}) {
    const Judgement j = judged(grey(), changed(5, levels));
    CHECK(j.good);
    CHECK(j.reached == Rung::kDriver);
  }
  const Judgement many = judged(grey(), changed(6, 1)), far = judged(grey(), changed(1, 4));
  CHECK_FALSE(many.good);
  CHECK(says(many, "0.12 % of the pixels"));
  CHECK_FALSE(far.good);
  CHECK(says(far, "4 levels"));
  CHECK(says(judged(changed(1, 4), grey()), "4 levels"));
  const Judgement size = judged(grey(), grey(50, 100));
  CHECK_FALSE(size.good);
  CHECK(says(size, "sizes"));
}

TEST_CASE("stricter and looser limits decide as they say") {
  Tolerance t;
  t.rung = Rung::kPixels;
  CHECK_FALSE(judged(grey(), changed(1, 1), t).good);
  CHECK(judged(grey(), grey(), t).good);
  t.rung = Rung::kBytes;
  CHECK_FALSE(judged(grey(), grey(), t).good);
  CHECK(judge(compare(grey(), grey()), true, nullptr, t).good);
  t.rung = Rung::kDriver;
  t.driver.levels = 4;
  CHECK(judged(grey(), changed(1, 4), t).good);
  t.driver.pixels = 0.0012;
  CHECK(judged(grey(), changed(6, 1), t).good);
}

TEST_CASE("a dense cluster of small differences is different where as many scattered ones are not") {
  const Image reference = grey(400, 400);  // 0.1 %: 160 pixels
  Image dense = reference, scattered = reference;
  for (int i = 0; i < 100; ++i) {
    dense.pixel(200 + i % 10, 100 + i / 10)[0] = 101;
    scattered.pixel(40 * (i % 10), 40 * (i / 10))[0] = 101;
  }
  const Judgement j = judged(reference, dense);
  CHECK_FALSE(j.good);
  CHECK(says(j, "cluster at 20"));  // 200 to 209 across
  CHECK(compare(reference, dense).cluster == doctest::Approx(100 / 256.0));
  CHECK(judged(reference, scattered).good);
  // A line, as of an edge that fell a pixel further, is no cluster.
  Image line = reference;
  for (int i = 0; i < 80; ++i) line.pixel(100 + i, 100 + i)[1] = line.pixel(101 + i, 100 + i)[1] = 103;
  CHECK(judged(reference, line).good);
}

TEST_CASE("the perceptual rung forgives what is hardly seen and not what is") {
  Tolerance t;
  t.rung = Rung::kPerceptual;
  const Judgement faint = judged(grey(), changed(5000, 1), t);  // everywhere, by one level
  CHECK_FALSE(judged(grey(), changed(5000, 1)).good);
  CHECK(faint.reached == Rung::kPerceptual);
  Image spot = grey();
  for (int y = 20; y < 32; ++y)
    for (int x = 40; x < 52; ++x) spot.pixel(x, y)[0] = 255;
  const Judgement seen = judged(grey(), spot, t);
  CHECK_FALSE(seen.good);
  CHECK(says(seen, "FLIP"));
  t.perceptual = {1, 1};
  CHECK(judged(grey(), spot, t).good);
}

TEST_CASE("differences are counted, alpha included") {
  for (const int channel : {0, 3}) {
    const ImageDifference d = compare(grey(), changed(250, 20, channel));
    CHECK(d.same_size);
    CHECK(d.pixels == 5000);
    CHECK(d.differing_pixels == 250);
    CHECK(d.max_levels == 20);
    CHECK(d.mean_levels == doctest::Approx(250 * 20 / 20000.0));
  }
  Image one = grey();
  one.pixel(17, 31)[2] = 0;
  const ImageDifference d = compare(grey(), one);
  CHECK(d.worst_x == 17);
  CHECK(d.worst_y == 31);
  CHECK(d.max_levels == 100);
  CHECK_FALSE(compare(grey(), grey(100, 51)).same_size);
}

TEST_CASE("what is covered does not differ, at the borders and beyond them") {
  const Image reference = grey();
  Image actual = changed(5000, 50);
  const PixelRectangle rectangles[] = {{90, 40, 60, 60}, {0, 0, 1, 1}, {95, 45, 2, 2}};
  CHECK(cover(reference, actual, rectangles) == 101);
  CHECK(compare(reference, actual).differing_pixels == 4899);
  std::vector<std::uint16_t> ids(5000, 7);
  for (const std::size_t row : {2u, 3u, 4u})  // three by three pixels of something else: its middle is left
    for (std::size_t x = 50; x < 53; ++x) ids[100 * row + x] = 65535;
  CHECK(cover(reference, actual, ids, {7, 8}) == 4999);
  CHECK(compare(reference, actual).differing_pixels == 1);
}

TEST_CASE("differences below 8 bits count as one level") {
  ImageDifference d = compare(grey(2, 1), grey(2, 1));
  add_finer_differences({0x6464, 0, 0, 0, 1, 2, 3, 4}, {0x6465, 0, 0, 0, 1, 2, 3, 4}, d);
  CHECK(d.differing_pixels == 1);
  CHECK(d.max_levels == 1);
}

TEST_CASE("the difference picture shows where pixels differ and keeps the rest grey") {
  const Image difference = difference_picture(grey(), changed(1, 1));
  CHECK(difference.pixel(0, 0)[0] > difference.pixel(0, 0)[2] + 50);
  CHECK(difference.pixel(1, 0)[0] == difference.pixel(1, 0)[2]);
  CHECK(difference.pixel(1, 0)[3] == 255);
  const Image sizes = difference_picture(grey(100, 50), grey(60, 80));
  CHECK(sizes.width == 100);
  CHECK(sizes.height == 80);
  CHECK(sizes.pixel(90, 10)[2] > sizes.pixel(90, 10)[0]);
}
