#include <doctest/doctest.h>
#include <fmt/format.h>

#include "render/error.h"
#include "render/frame_writer.h"
#include "tests/render/scratch_folder.h"

using namespace softreel::render;
using softreel::render::test::read_bytes;
using softreel::render::test::ScratchFolder;

namespace {

Image plain(int level) {
  Image image = Image::blank(64, 48);
  image.rgba.assign(image.rgba.size(), static_cast<std::uint8_t>(level));
  return image;
}

}  // namespace

TEST_CASE("frames are written whole with any number of threads, with the same bytes as without") {
  for (const int threads : {1, 3}) {
    const ScratchFolder folder;
    FrameWriter writer(threads, 2);
    for (int i = 0; i < 20; ++i)
      writer.write(folder / fmt::format("{}.png", i), plain(i), {{"frame", fmt::format("{}", i)}});
    writer.finish();
    CHECK(writer.frames_written() == 20);
    CHECK(folder.file_count() == 20);
    for (int i = 0; i < 20; ++i)
      CHECK(read_bytes(folder / fmt::format("{}.png", i)) == encode_png(plain(i), {{"frame", fmt::format("{}", i)}}));
  }
}

TEST_CASE("an error of the writing thread reaches the caller, and later frames are not written") {
  const ScratchFolder folder;
  FrameWriter writer(1, 1);
  const auto write_until_error = [&] {
    writer.write(folder / "no/such/folder.png", plain(0));
    for (int i = 0; i < 100; ++i) writer.write(folder / fmt::format("{}.png", i), plain(i));
  };
  CHECK_THROWS_AS(write_until_error(), RenderError);
  CHECK_THROWS_AS(writer.finish(), RenderError);
  CHECK(writer.frames_written() == 0);
  CHECK(folder.file_count() == 0);
}

TEST_CASE("an error in the last frame is seen by finish") {
  const ScratchFolder folder;
  FrameWriter writer;
  writer.write(folder / "no/such/folder.png", plain(0));
  CHECK_THROWS_AS(writer.finish(), RenderError);
}

TEST_CASE("a writer that is left without finish still writes what it accepted") {
  const ScratchFolder folder;
  {
    FrameWriter writer(2, 8);
    for (int i = 0; i < 8; ++i) writer.write(folder / fmt::format("{}.png", i), plain(i));
  }
  CHECK(folder.file_count() == 8);
}
