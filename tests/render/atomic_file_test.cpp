#include <doctest/doctest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>

#include "render/atomic_file.h"
#include "render/error.h"
#include "tests/render/scratch_folder.h"

using namespace softreel::render;
using softreel::render::test::read_bytes;
using softreel::render::test::ScratchFolder;
using softreel::render::test::write_bytes;

namespace {

std::string complaint(const std::filesystem::path& path, std::size_t size) {
  try {
    write_file_atomically(path, std::vector<unsigned char>(size, 7));
  } catch (const RenderError& error) {
    CHECK(error.kind() == RenderErrorKind::kOutput);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a file appears whole and replaces the one before") {
  const ScratchFolder folder;
  write_bytes(folder / "a", {1, 2, 3});
  const std::vector<unsigned char> bytes(100000, 9);
  write_file_atomically(folder / "a", bytes);
  CHECK(read_bytes(folder / "a") == bytes);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a folder that is not there is named with the reason") {
  const ScratchFolder folder;
  const std::string message = complaint(folder / "no/such/frame.png", 10);
  CHECK(message.find("frame.png") != std::string::npos);
  CHECK(message.find("No such file or directory") != std::string::npos);
}

TEST_CASE("a target that cannot be replaced leaves nothing behind") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "taken/inside");
  CHECK_FALSE(complaint(folder / "taken", 10).empty());
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a full disk is noticed, the old file stays, nothing is left behind") {
  const ScratchFolder folder;
  if (::geteuid() != 0 || ::mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
    MESSAGE("needs the right to mount a small tmpfs: not checked");
    return;
  }
  write_bytes(folder / "frame.png", {1, 2, 3});
  const std::string message = complaint(folder / "frame.png", 200000);
  const bool old_file_there = read_bytes(folder / "frame.png") == std::vector<unsigned char>{1, 2, 3};
  const std::size_t files = folder.file_count();
  ::umount(folder.path().c_str());
  CHECK(message.find("No space left on device") != std::string::npos);
  CHECK(old_file_there);
  CHECK(files == 1);
}
