#include <doctest/doctest.h>

#include "render/compare_images.h"

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

}  // namespace

TEST_CASE("the verdict climbs from same over driver to different exactly at the limits") {
  // 5000 pixels: 0.1 % are 5.
  CHECK(compare(grey(), grey()).verdict == ImageVerdict::kSame);
  CHECK(compare(grey(), changed(1, 1)).verdict == ImageVerdict::kDriver);
  CHECK(compare(grey(), changed(5, 3)).verdict == ImageVerdict::kDriver);
  CHECK(compare(grey(), changed(5, -3)).verdict == ImageVerdict::kDriver);
  CHECK(compare(grey(), changed(6, 1)).verdict == ImageVerdict::kDifferent);
  CHECK(compare(grey(), changed(1, 4)).verdict == ImageVerdict::kDifferent);
  CHECK(compare(grey(), grey(50, 100)).verdict == ImageVerdict::kDifferent);
  CHECK(compare(changed(1, 4), grey()).verdict == ImageVerdict::kDifferent);
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

TEST_CASE("the difference image shows where pixels differ and keeps the rest grey") {
  const Image difference = difference_image(grey(), changed(1, 1));
  CHECK(difference.pixel(0, 0)[0] > difference.pixel(0, 0)[2] + 50);
  CHECK(difference.pixel(1, 0)[0] == difference.pixel(1, 0)[2]);
  CHECK(difference.pixel(1, 0)[3] == 255);
  const Image sizes = difference_image(grey(100, 50), grey(60, 80));
  CHECK(sizes.width == 100);
  CHECK(sizes.height == 80);
  CHECK(sizes.pixel(90, 10)[2] > sizes.pixel(90, 10)[0]);
}
