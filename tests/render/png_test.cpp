#include <doctest/doctest.h>

#include <random>
#include <stdexcept>

#include "render/image_io.h"
#include "render/png.h"
#include "tests/render/scratch_folder.h"

using namespace softreel::render;
using softreel::render::test::read_bytes;
using softreel::render::test::ScratchFolder;
using softreel::render::test::write_bytes;

namespace {

Image noise(int width, int height, std::uint32_t seed, bool opaque) {
  std::mt19937 bits(seed);
  Image image = Image::blank(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    image.rgba[i] = opaque && i % 4 == 3 ? 255 : static_cast<std::uint8_t>(bits() >> 24);
  return image;
}

}  // namespace

TEST_CASE("a picture comes back from PNG pixel for pixel, odd sizes and alpha included") {
  const ScratchFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 7}, {640, 359}})
    for (const bool opaque : {true, false}) {
      const Image image = noise(width, height, 3, opaque);
      write_png(folder / "a.png", image, {{"softreel:frame", "12"}});
      CHECK(load_image(folder / "a.png") == image);
    }
}

TEST_CASE("texts come back from PNG, and the same input gives the same bytes") {
  const ScratchFolder folder;
  const PngText text{{"softreel:frame", "12"}, {"softreel:hash", "00ff"}, {"empty", ""}};
  const Image image = noise(33, 21, 1, true);
  write_png(folder / "a.png", image, text);
  CHECK(read_png_text(folder / "a.png") == text);
  CHECK(read_bytes(folder / "a.png") == encode_png(image, text));
  write_png(folder / "b.png", image);
  CHECK(read_png_text(folder / "b.png") == PngText{});
}

TEST_CASE("keywords and texts that PNG does not allow are refused") {
  const Image image = noise(2, 2, 1, true);
  CHECK_THROWS_AS(encode_png(image, {{"", "x"}}), std::invalid_argument);
  CHECK_THROWS_AS(encode_png(image, {{std::string(80, 'k'), "x"}}), std::invalid_argument);
  CHECK_THROWS_AS(encode_png(image, {{"new\nline", "x"}}), std::invalid_argument);
  CHECK_THROWS_AS(encode_png(image, {{"nul", std::string(1, '\0')}}), std::invalid_argument);
  CHECK_THROWS_AS(encode_png(Image{}), std::invalid_argument);
}

TEST_CASE("a PNG cut off at any byte is not taken for a complete one") {
  const ScratchFolder folder;
  const std::vector<unsigned char> whole = encode_png(noise(16, 9, 2, true), {{"softreel:frame", "1"}});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_bytes(folder / "cut.png", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    REQUIRE_FALSE(read_png_text(folder / "cut.png").has_value());
  }
}

TEST_CASE("a PNG with any changed byte is not taken for a complete one") {
  const ScratchFolder folder;
  std::vector<unsigned char> bytes = encode_png(noise(16, 9, 2, true), {{"softreel:frame", "1"}});
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] ^= 0x10;
    write_bytes(folder / "changed.png", bytes);
    REQUIRE_FALSE(read_png_text(folder / "changed.png").has_value());
    bytes[i] ^= 0x10;
  }
}

TEST_CASE("reading texts survives garbage, absurd chunk lengths, folders and missing files") {
  const ScratchFolder folder;
  std::mt19937 bits(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<unsigned char> bytes = encode_png(noise(4, 4, 2, true));
    bytes.resize(8 + bits() % 60);
    for (std::size_t i = 8; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(bits());
    write_bytes(folder / "garbage.png", bytes);
    REQUIRE_FALSE(read_png_text(folder / "garbage.png").has_value());
  }
  CHECK_FALSE(read_png_text(folder.path()).has_value());
  CHECK_FALSE(read_png_text(folder / "missing.png").has_value());
  CHECK_FALSE(read_png_text("/dev/zero").has_value());
}

TEST_CASE("bytes after the end of a PNG are not a complete frame either") {
  const ScratchFolder folder;
  std::vector<unsigned char> bytes = encode_png(noise(4, 4, 2, true));
  bytes.push_back(0);
  write_bytes(folder / "long.png", bytes);
  CHECK_FALSE(read_png_text(folder / "long.png").has_value());
}
