// Pictures of every kind and condition: a clear answer, the right exit code, no crash.
#include <sys/resource.h>
#include <sys/stat.h>

#include "render/image_io.h"
#include "render/png.h"
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"
#include "tests/app/comparison.h"
#include "tests/app/raw_png.h"

using namespace softreel;
namespace fs = std::filesystem;

namespace {

/// 8 x 8 pixels of one colour, CMYK with Adobe's marker.
constexpr const char* kCmykJpeg =
    "ffd8ffee000e41646f626500640000000002ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17202e2931302e29"
    "2d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffdb0043010e0e0e131113261515264f352d354f4f4f4f"
    "4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4fffc000140800080008"
    "04012200021101031101042200ffc400160001010100000000000000000000000000000206ffc400141001000000000000000000000000"
    "00000000ffc4001501010100000000000000000000000000000506ffc40014110100000000000000000000000000000000ffda000e0401"
    "00021103110400003f009000a45b601fffd9";

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

std::string repeated(const std::string& pixel, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += pixel;
  return bytes;
}

}  // namespace

TEST_CASE("A missing picture is a no, what is no picture is an error, also when it is the same twice") {
  test::TempFolder folder;
  const auto picture = folder / "picture.png";
  render::write_png(picture, test::gradient());
  const std::string bytes = test::slurp(picture);
  const auto noise = folder.write("noise.png", "these are no pixels"),
             twin = folder.write("twin.png", "these are no pixels");
  CHECK(test::compare(folder / "none.png", picture).code == 1);
  CHECK(test::compare(picture, folder / "none.png").code == 1);
  CHECK(test::compare(picture, std::string(5000, 'a')).code == 1);
  CHECK(test::compare(noise, twin).code == 3);
  CHECK(test::compare(picture, folder.write("empty.png", "")).code == 3);
  // Every way to cut it short, and every damaged byte behind the signature, but in a text nobody needs.
  for (std::size_t size = 1; size < bytes.size(); size += 1 + bytes.size() / 17) {
    const test::RunResult result = test::compare(picture, folder.write("half.png", bytes.substr(0, size)));
    INFO(size << " bytes: " << result.err);
    CHECK(result.code == 3);
    CHECK(test::contains(result.err, "half.png"));
  }
  for (std::size_t at = 8; at < bytes.size(); at += 1 + bytes.size() / 23) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    const test::RunResult result = test::compare(picture, folder.write("damaged.png", damaged));
    INFO("byte " << at << ": " << result.out << result.err);
    CHECK(result.code == 3);
    CHECK(test::contains(result.err, "damaged.png"));
  }
}

TEST_CASE("Palette, grey, grey with alpha, RGBA and CMYK pictures are compared by what they show") {
  test::TempFolder folder;
  const auto expect_same = [&](const std::string& a, const std::string& b, int code) {
    const test::RunResult result = test::compare(folder.write("a.png", a), folder.write("b.png", b));
    INFO(result.out << result.err);
    CHECK(result.code == code);
  };
  const std::string rgb = test::raw_png(6, 5, 8, 2, repeated("\x40\x40\x40", 30));
  expect_same(rgb, test::raw_png(6, 5, 8, 0, repeated("\x40", 30)), 0);
  expect_same(rgb, test::raw_png(6, 5, 8, 0, repeated("\x60", 30)), 1);
  expect_same(rgb, test::raw_png(6, 5, 8, 4, repeated("\x40\xff", 30)), 0);
  expect_same(rgb, test::raw_png(6, 5, 8, 4, repeated("\x40\x80", 30)), 1);
  expect_same(rgb, test::raw_png(6, 5, 8, 6, repeated("\x40\x40\x40\xff", 30)), 0);
  expect_same(rgb, test::raw_png(6, 5, 8, 3, repeated("\x01", 30), "abc\x40\x40\x40"), 0);
  expect_same(rgb, test::raw_png(6, 5, 8, 3, repeated(std::string(1, '\0'), 30), "abc\x40\x40\x40"), 1);

  const auto cmyk = folder.write("cmyk.jpg", from_hex(kCmykJpeg));
  const render::Image shown = render::load_image(cmyk);
  REQUIRE(shown.width == 8);
  render::write_png(folder / "shown.png", shown);
  CHECK(test::compare(folder / "shown.png", cmyk, {"--tolerance", "pixels"}).code == 0);
  CHECK(test::compare(cmyk, cmyk).code == 0);
}

TEST_CASE("16 bits a channel: the upper ones count as usual, what differs below counts as one level") {
  test::TempFolder folder;
  const auto deep = [&](const char* name, const std::string& sample, int changed, const std::string& other) {
    return folder.write(name,
                        test::raw_png(60, 50, 16, 0, repeated(other, changed) + repeated(sample, 3000 - changed)));
  };
  const std::string base("\x40\x10", 2), fine("\x40\x20", 2), coarse("\x48\x10", 2);
  const auto a = deep("a.png", base, 0, base), three = deep("three.png", base, 3, fine),
             many = deep("many.png", base, 9, fine), far = deep("far.png", base, 1, coarse);
  const test::RunResult small = test::compare(a, three);
  CHECK(small.code == 0);
  CHECK(test::contains(small.out, "3 of 3000 pixels"));
  CHECK(test::contains(small.out, "16 bits a channel"));
  CHECK(test::compare(a, three, {"--tolerance", "pixels"}).code == 1);
  CHECK(test::compare(a, many).code == 1);
  CHECK(test::contains(test::compare(a, far).out, "at most 8 levels"));
}

TEST_CASE("Huge pictures are refused before memory is asked for") {
  test::TempFolder folder;
  const auto picture = folder / "picture.png";
  render::write_png(picture, test::gradient());
  rlimit before{}, little{};
  getrlimit(RLIMIT_AS, &before);
  little = before;
  little.rlim_cur = std::size_t{3} << 30;  // the program itself needs little of it
  for (const auto& [width, height] : {std::pair{100000, 100000}, {2000000000, 1}, {16384, 16384}, {0, 5}}) {
    const auto huge = folder.write("huge.png", test::raw_png(width, height, 8, 6, "few"));
    setrlimit(RLIMIT_AS, &little);
    const test::RunResult result = test::compare(picture, huge);
    setrlimit(RLIMIT_AS, &before);
    INFO(width << " x " << height << ": " << result.err);
    CHECK(result.code == 3);
    CHECK(result.signal == 0);
    CHECK(test::contains(result.err, "huge.png"));
  }
}

TEST_CASE("Folders: without pictures, the same one twice, with something unreadable inside") {
  test::TempFolder folder;
  const fs::path full = folder / "full", other = folder / "other", empty = folder / "empty";
  for (const fs::path& f : {full, other, empty}) fs::create_directories(f);
  render::write_png(full / "f1.png", test::gradient());
  render::write_png(other / "f1.png", test::gradient());
  std::ofstream(empty / "notes.txt") << "no picture";
  fs::create_directories(empty / "folder.png");
  fs::create_directory_symlink(full, folder / "again");
  const auto refused = [&](const fs::path& a, const fs::path& b, int code, const std::string& says) {
    test::check_refused({says, {"compare", a.string(), b.string()}, code, {says}});
  };
  refused(full, empty, 3, "there is no picture in this folder");
  refused(empty, full, 3, "there is no picture in this folder");
  refused(full, full, 2, "the same folder");
  refused(full, folder / "again", 2, "the same folder");
  refused(full, full / "f1.png", 2, "not a picture and a folder");
  fs::create_symlink(folder / "nowhere.png", other / "f2.png");
  refused(full, other, 3, "f2.png");
  fs::remove(other / "f2.png");
  REQUIRE(mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
  refused(full / "f1.png", folder / "pipe.png", 3, "not a file");
  std::ofstream(other / "f0.png") << "no pixels";
  refused(full, other, 3, "f0.png");
}
