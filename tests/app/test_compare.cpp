#include "render/image.h"
#include "render/image_io.h"
#include "render/png.h"
#include "tests/app/clip.h"

using namespace softreel;
namespace fs = std::filesystem;

namespace {

render::Image gradient(int width = 60, int height = 50) {
  render::Image image;
  image.width = width;
  image.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int v : {x * 4, y * 4, 100, 255}) image.rgba.push_back(static_cast<unsigned char>(v));
  return image;
}

/// The gradient with `levels` more of green on the first `pixels` pixels.
render::Image changed(int levels, int pixels) {
  render::Image image = gradient();
  for (int i = 0; i < pixels; ++i) {
    unsigned char& green = image.rgba[static_cast<std::size_t>(4 * i + 1)];
    green = static_cast<unsigned char>(green + levels);
  }
  return image;
}

test::RunResult compare(const fs::path& a, const fs::path& b, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"compare", a.string(), b.string()});
  return test::run(more);
}

}  // namespace

TEST_CASE("Two pictures: same bytes, same pixels, within what drivers differ in, different") {
  test::TempFolder folder;
  const auto reference = folder / "reference.png", actual = folder / "actual.png";
  render::write_png(reference, gradient());
  const auto expect = [&](const render::Image& image, const std::string& says, int code,
                          std::vector<std::string> more = {}, const render::PngText& text = {}) {
    render::write_png(actual, image, text);
    const test::RunResult result = compare(reference, actual, std::move(more));
    INFO(result.out << result.err);
    CHECK(result.code == code);
    CHECK(test::contains(result.out, says));
  };
  expect(gradient(), "same bytes", 0);
  expect(gradient(), "same pixels", 0, {}, {{"Software", "another"}});
  expect(gradient(), "same pixels", 0, {"--tolerance", "same"}, {{"Software", "another"}});
  expect(changed(3, 3), "within driver tolerance", 0);  // 0.1 % of 3000 pixels
  expect(changed(3, 3), "3 of 3000 pixels", 1, {"--tolerance", "same"});
  expect(changed(3, 4), "4 of 3000 pixels", 1);
  expect(changed(4, 1), "at most 4 levels", 1);
  expect(gradient(50, 60), "different sizes", 1);
}

TEST_CASE("A difference image shows where two pictures differ, and is written only then") {
  test::TempFolder folder;
  const auto reference = folder / "reference.png", actual = folder / "actual.png", picture = folder / "difference.png";
  render::write_png(reference, gradient());
  render::write_png(actual, changed(2, 1));
  CHECK(compare(reference, actual, {"-o", picture.string()}).code == 0);
  CHECK_FALSE(fs::exists(picture));
  render::write_png(actual, changed(100, 30));
  CHECK(compare(reference, actual, {"-o", picture.string()}).code == 1);
  const render::Image difference = render::load_image(picture);
  CHECK(difference.width == 60);
  CHECK(difference.height == 50);
  const auto colorful = [&](std::size_t pixel) {
    return difference.rgba[4 * pixel] != difference.rgba[4 * pixel + 1] ||
           difference.rgba[4 * pixel] != difference.rgba[4 * pixel + 2] || difference.rgba[4 * pixel] == 255;
  };
  CHECK(colorful(0));
  CHECK(colorful(29));
  CHECK_FALSE(colorful(30));
  CHECK(compare(reference, actual, {"-o", (folder / "none/d.png").string()}).code == 5);
}

TEST_CASE("Two folders: missing and extra frames count, the worst is named") {
  test::TempFolder folder;
  const fs::path reference = folder / "reference", actual = folder / "actual", differences = folder / "differences";
  fs::create_directories(reference);
  fs::create_directories(actual);
  for (const char* name : {"frame_0001.png", "frame_0002.png", "frame_0003.png"}) {
    render::write_png(reference / name, gradient());
    render::write_png(actual / name, gradient());
  }
  std::ofstream(actual / "notes.txt") << "no picture";
  fs::create_directories(actual / "cache");
  const test::RunResult same = compare(reference, actual);
  CHECK(same.code == 0);
  CHECK(test::contains(same.out, "0 of 3 frames differ"));

  render::write_png(actual / "frame_0001.png", changed(9, 2));
  render::write_png(actual / "frame_0002.png", changed(50, 2));
  const test::RunResult two = compare(reference, actual, {"-o", differences.string()});
  INFO(two.out);
  CHECK(two.code == 1);
  CHECK(test::contains(two.out, "worst: frame_0002.png"));
  CHECK(test::contains(two.out, "at most 50 levels"));
  CHECK(test::contains(two.out, "2 of 3 frames differ"));
  CHECK(test::pictures_in(differences).size() == 2);

  fs::rename(actual / "frame_0003.png", actual / "frame_0009.png");
  const test::RunResult moved = compare(reference, actual);
  INFO(moved.out);
  CHECK(moved.code == 1);
  CHECK(test::contains(moved.out, "frame_0003.png: missing"));
  CHECK(test::contains(moved.out, "frame_0009.png: has no reference"));
  CHECK(test::contains(moved.out, "4 of 4 frames differ"));
}

TEST_CASE("A missing picture is a no, what is no picture is an error, also when it is the same twice") {
  test::TempFolder folder;
  const auto picture = folder / "picture.png";
  render::write_png(picture, gradient());
  const auto noise = folder.write("noise.png", "these are no pixels"),
             twin = folder.write("twin.png", "these are no pixels");
  const auto half = folder.write("half.png", test::slurp(picture).substr(0, 200));
  CHECK(compare(folder / "none.png", picture).code == 1);
  CHECK(compare(picture, folder / "none.png").code == 1);
  CHECK(compare(std::string(5000, 'a'), picture).code == 1);
  for (const auto& bad : {noise, half}) {
    const test::RunResult result = compare(picture, bad);
    CHECK(result.code == 3);
    CHECK(test::contains(result.err, bad.filename().string()));
  }
  CHECK(compare(noise, twin).code == 3);
  fs::create_directories(folder / "empty");
  CHECK(compare(folder / "empty", folder / "empty").code == 3);
}
