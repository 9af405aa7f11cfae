#include <doctest/doctest.h>

#include <random>
#include <span>

#include "render/error.h"
#include "render/image_io.h"
#include "render/png.h"
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

TEST_CASE("kinds of pictures whose readers are not safe are not read") {
  const ScratchFolder folder;
  for (const std::string header : {"P6 2 2 65535\n", "P5 2 2 255\n", "GIF89a", "8BPS"}) {
    std::vector<unsigned char> file(header.begin(), header.end());
    file.resize(file.size() + 64, 1);
    write_bytes(folder / "picture", file);
    CHECK(complaint(folder / "picture").find("PNG, JPEG, TGA, BMP and HDR can be read") != std::string::npos);
  }
}
