#include <doctest/doctest.h>

#include <random>
#include <span>

#include "render/error.h"
#include "render/image_io.h"
#include "render/png.h"
#include "render/png16.h"
#include "tests/render/scratch_folder.h"

using namespace softreel::render;
using softreel::render::test::ScratchFolder;
using softreel::render::test::write_bytes;

namespace {

/// What load_image says about a file; empty when it accepts it.
std::string complaint(const std::filesystem::path& path) {
  try {
    load_image(path);
  } catch (const RenderError& error) {
    CHECK(error.kind() == RenderErrorKind::kInput);
    return error.what();
  }
  return {};
}

std::vector<unsigned char> bmp_header(std::uint32_t width, std::uint32_t height) {
  std::vector<unsigned char> bytes{'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0};
  const auto append = [&](std::uint32_t v) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<unsigned char>(v >> (8 * i)));
  };
  append(width);
  append(height);
  bytes.insert(bytes.end(), {1, 0, 24, 0});
  bytes.resize(54, 0);
  return bytes;
}

}  // namespace

TEST_CASE("what is not a picture is refused with the file's name") {
  const ScratchFolder folder;
  const std::string text = "this is not a picture";
  write_bytes(folder / "empty.png", {});
  write_bytes(folder / "text.png", {text.begin(), text.end()});
  for (const char* name : {"missing.png", "empty.png", "text.png", "."}) {
    const std::string message = complaint(folder / name);
    CHECK_FALSE(message.empty());
    CHECK(message.find((folder / name).string()) != std::string::npos);
  }
}

TEST_CASE("absurd sizes are refused before memory is asked for") {
  const ScratchFolder folder;
  write_bytes(folder / "wide.bmp", bmp_header(2000000000, 2000000000));
  CHECK_FALSE(complaint(folder / "wide.bmp").empty());
  write_bytes(folder / "flat.bmp", bmp_header(100000, 1));
  CHECK_FALSE(complaint(folder / "flat.bmp").empty());
}

TEST_CASE("truncated and random picture files never do worse than an error") {
  const ScratchFolder folder;
  Image image = Image::blank(20, 10);
  std::vector<unsigned char> whole = encode_png(image);
  for (std::size_t length = 1; length + 12 < whole.size(); ++length) {
    write_bytes(folder / "cut.png", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    complaint(folder / "cut.png");
  }
  std::mt19937 bits(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<unsigned char> changed = whole;
    for (int i = 0; i < 4; ++i) changed[bits() % changed.size()] = static_cast<unsigned char>(bits());
    write_bytes(folder / "changed.png", changed);
    complaint(folder / "changed.png");
  }
  CHECK(complaint(folder / "cut.png").find("cut.png") != std::string::npos);
}

TEST_CASE("pictures can come from memory, and are named in errors") {
  const std::vector<unsigned char> png = encode_png(Image::blank(5, 4));
  const Image image = load_image(std::as_bytes(std::span(png)), "scene.glb: texture 2");
  CHECK(image.width == 5);
  CHECK(image.height == 4);
  try {
    load_image(std::as_bytes(std::span(png).first(30)), "scene.glb: texture 2");
    FAIL("accepted");
  } catch (const RenderError& error) {
    CHECK(std::string(error.what()).find("scene.glb: texture 2") != std::string::npos);
  }
}

TEST_CASE("a JPEG whose Huffman table has more codes than there are bytes is refused, wherever it stands") {
  // Found by fuzzing: stb_image writes such a table beyond its end.
  const ScratchFolder folder;
  std::vector<unsigned char> table{0xff, 0xc4, 0x01, 0x20, 0x00};
  for (int i = 0; i < 16; ++i) table.push_back(17);  // 272 codes
  table.resize(table.size() + 272);
  const std::vector<unsigned char> comment{0xff, 0xfe, 0, 4, 'h', 'i'}, scan{0xff, 0xda, 0, 2, 1, 2, 3};
  for (const auto& before : {std::vector<unsigned char>{}, comment, scan, std::vector<unsigned char>{0, 1}}) {
    std::vector<unsigned char> file{0xff, 0xd8};
    file.insert(file.end(), before.begin(), before.end());
    file.insert(file.end(), table.begin(), table.end());
    write_bytes(folder / "table.jpg", file);
    CHECK(complaint(folder / "table.jpg").find("Huffman") != std::string::npos);
  }
}

TEST_CASE("an HDR picture that is cut short or has runs of no length is refused at once, wherever it ends") {
  // 8 x 2 pixels, run-length encoded: each channel of a row as one run of 8 and, in the second row, as 8 single values.
  std::string whole = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
  const std::size_t header = whole.size();
  const std::string row("\x02\x02\x00\x08", 4);
  whole += row;
  for (int channel = 0; channel < 4; ++channel) whole += "\x88\x80";
  whole += row;
  for (int channel = 0; channel < 4; ++channel) whole += std::string("\x08") + std::string(8, '\x7f');
  const auto load = [](const std::string& text) {
    return load_image(std::as_bytes(std::span(text.data(), text.size())), "light.hdr");
  };
  const Image image = load(whole);
  CHECK(image.width == 8);
  CHECK(image.height == 2);
  for (std::size_t size = header; size < whole.size(); ++size)
    CHECK_THROWS_AS(load(whole.substr(0, size)), RenderError);
  std::string empty_run = whole;
  empty_run[header + 4] = '\0';
  CHECK_THROWS_WITH_AS(load(empty_run), doctest::Contains("a run of its pixels has no length"), RenderError);
  std::string too_long = whole;
  too_long[header + 4] = '\x89';
  CHECK_THROWS_WITH_AS(load(too_long), doctest::Contains("beyond the end of a row"), RenderError);
}

TEST_CASE("kinds of pictures whose readers are not safe are not read") {
  const ScratchFolder folder;
  for (const std::string header : {"P6 2 2 65535\n", "P5 2 2 255\n", "GIF89a", "8BPS"}) {
    std::vector<unsigned char> file(header.begin(), header.end());
    file.resize(file.size() + 64, 1);
    write_bytes(folder / "picture", file);
    CHECK(complaint(folder / "picture").find("PNG, JPEG, TGA, BMP and HDR can be read") != std::string::npos);
  }
}

TEST_CASE("palette and 16-bit pictures are read as what they show") {
  const ScratchFolder folder;
  // 2 x 2: red, green, (10, 20, 30), red.
  const std::vector<unsigned char> palette = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
      0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x03, 0x00, 0x00, 0x00, 0x45, 0x68, 0xfd, 0x16, 0x00, 0x00, 0x00, 0x09, 0x50,
      0x4c, 0x54, 0x45, 0xff, 0x00, 0x00, 0x00, 0xff, 0x00, 0x0a, 0x14, 0x1e, 0xd9, 0x7e, 0x4d, 0xe7, 0x00, 0x00, 0x00,
      0x0e, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x60, 0x60, 0x64, 0x60, 0x62, 0x00, 0x00, 0x00, 0x0e, 0x00, 0x04,
      0xdb, 0xe0, 0x32, 0x8e, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  write_bytes(folder / "palette.png", palette);
  const Image image = load_image(folder / "palette.png");
  CHECK(image.rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 10, 20, 30, 255, 255, 0, 0, 255});
  const std::vector<std::uint16_t> deep = {0x1234, 0xffff, 0, 0x8000, 0x00ff, 0x0100};
  write_png16(folder / "deep.png", 2, 1, 3, deep);
  CHECK(load_image(folder / "deep.png").rgba == std::vector<std::uint8_t>{0x12, 0xff, 0, 255, 0x80, 0, 1, 255});
  CHECK_THROWS_AS(write_png16(folder / "bad.png", 2, 2, 1, deep), std::invalid_argument);
}

TEST_CASE("a CMYK picture gives its colours, or an error that names it") {
  const ScratchFolder folder;
  // 8 x 8, red, JPEG with four components.
  write_bytes(
      folder / "cmyk.jpg",
      std::vector<unsigned char>{
          0xff, 0xd8, 0xff, 0xee, 0x00, 0x0e, 0x41, 0x64, 0x6f, 0x62, 0x65, 0x00, 0x64, 0x00, 0x00, 0x00, 0x00, 0x02,
          0xff, 0xdb, 0x00, 0x43, 0x00, 0x10, 0x0b, 0x0c, 0x0e, 0x0c, 0x0a, 0x10, 0x0e, 0x0d, 0x0e, 0x12, 0x11, 0x10,
          0x13, 0x18, 0x28, 0x1a, 0x18, 0x16, 0x16, 0x18, 0x31, 0x23, 0x25, 0x1d, 0x28, 0x3a, 0x33, 0x3d, 0x3c, 0x39,
          0x33, 0x38, 0x37, 0x40, 0x48, 0x5c, 0x4e, 0x40, 0x44, 0x57, 0x45, 0x37, 0x38, 0x50, 0x6d, 0x51, 0x57, 0x5f,
          0x62, 0x67, 0x68, 0x67, 0x3e, 0x4d, 0x71, 0x79, 0x70, 0x64, 0x78, 0x5c, 0x65, 0x67, 0x63, 0xff, 0xdb, 0x00,
          0x43, 0x01, 0x11, 0x12, 0x12, 0x18, 0x15, 0x18, 0x2f, 0x1a, 0x1a, 0x2f, 0x63, 0x42, 0x38, 0x42, 0x63, 0x63,
          0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63,
          0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63,
          0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0x63, 0xff, 0xc0, 0x00, 0x14, 0x08, 0x00,
          0x08, 0x00, 0x08, 0x04, 0x01, 0x22, 0x00, 0x02, 0x11, 0x01, 0x03, 0x11, 0x01, 0x04, 0x22, 0x00, 0xff, 0xc4,
          0x00, 0x16, 0x00, 0x01, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
          0x00, 0x00, 0x05, 0x07, 0xff, 0xc4, 0x00, 0x14, 0x10, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
          0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0xc4, 0x00, 0x15, 0x01, 0x01, 0x01, 0x00, 0x00, 0x00,
          0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x05, 0x06, 0xff, 0xc4, 0x00, 0x14, 0x11,
          0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff,
          0xda, 0x00, 0x0e, 0x04, 0x01, 0x00, 0x02, 0x11, 0x03, 0x11, 0x04, 0x00, 0x00, 0x3f, 0x00, 0xb4, 0x01, 0x44,
          0x1b, 0x40, 0x01, 0xff, 0xd9});
  const std::string complained = complaint(folder / "cmyk.jpg");
  if (!complained.empty()) {
    CHECK(complained.find("cmyk.jpg") != std::string::npos);
    return;
  }
  const Image image = load_image(folder / "cmyk.jpg");
  CHECK(image.pixel(4, 4)[0] > 180);
  CHECK(image.pixel(4, 4)[1] < 80);
  CHECK(image.pixel(4, 4)[2] < 80);
}
