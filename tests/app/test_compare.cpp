#include "render/image.h"
#include "render/image_io.h"
#include "render/png.h"
#include "tests/app/clip.h"
#include "tests/app/comparison.h"

using namespace softreel;
namespace fs = std::filesystem;

using test::changed;
using test::compare;
using test::gradient;

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
  expect(changed(3, 3), "within driver", 0);  // 0.1 % of 3000 pixels
  expect(changed(3, 3), "3 of 3000 pixels", 1, {"--tolerance", "same"});
  expect(changed(3, 4), "4 of 3000 pixels", 1);
  expect(changed(4, 1), "at most 4 levels", 1);
  expect(gradient(50, 60), "different: 50 x 60 pixels", 1);
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
  // What has no reference lies beside its place, and is no reference by that.
  CHECK(test::slurp(reference / "frame_0009.actual.png") == test::slurp(actual / "frame_0009.png"));
  CHECK(test::contains(compare(reference, actual).out, "4 of 4 frames differ"));
}

TEST_CASE("Tolerances by name and number decide, and the answer names the limit") {
  test::TempFolder folder;
  const auto a = folder / "a.png", b = folder / "b.png";
  render::write_png(a, gradient());
  render::write_png(b, changed(5, 9));  // 0.3 %
  const auto expect = [&](const std::string& tolerance, int code, const std::string& says) {
    const test::RunResult result = compare(a, b, {"--tolerance", tolerance});
    INFO(tolerance << ": " << result.out << result.err);
    CHECK(result.code == code);
    CHECK(test::contains(result.out + result.err, says));
  };
  expect("driver", 1, "decided by: 5 levels, at most 3 allowed");
  expect("levels=5", 1, "decided by: 0.3 % of the pixels, at most 0.1 % allowed");
  expect("driver,levels=5,pixels=0.3%", 0, "within driver");
  expect("pixels=0.003,levels=5", 0, "within driver");
  expect("same", 1, "9 pixels differ, the same pixels were asked for");
  expect("bytes", 1, "the same bytes were asked for");
  expect("perceptual", 0, "within perceptual");
  expect("flip=0.000001", 1, "decided by: FLIP 0.00");
  for (const char* bad : {"", "loose", "levels=300", "levels=-1", "pixels=nan", "pixels=101%", "flip=x", "driver,same",
                          "driver,flip=0.1", "levels=5,", "level=5"})
    expect(bad[0] == 0 ? "," : bad, 2, "allowed are");
}

TEST_CASE("Masks and exceptions: what they cover does not count, and mistakes in them are told with their place") {
  test::TempFolder folder;
  const fs::path reference = folder / "reference", actual = folder / "actual", ids = folder / "ids";
  for (const fs::path& f : {reference, actual, ids}) fs::create_directories(f);
  render::Image bodies = render::Image::blank(60, 50);
  for (std::size_t i = 0; i < bodies.rgba.size(); ++i)
    bodies.rgba[i] = i % 4 == 3 ? 255 : (i / 4 < 3 * 60 && i / 4 % 60 < 30) ? 7 : 0;
  for (const char* name : {"f1.png", "f2.png"}) {
    render::write_png(reference / name, gradient());
    render::write_png(actual / name, changed(90, 30));  // half of the first row
    render::write_png(ids / name, bodies);
  }
  const auto bad_frames = [&](std::vector<std::string> more) {
    return test::contains(compare(reference, actual, more).out, "\n2 of 2")   ? 2
           : test::contains(compare(reference, actual, more).out, "\n1 of 2") ? 1
                                                                              : 0;
  };
  CHECK(bad_frames({}) == 2);
  CHECK(bad_frames({"--mask", "0,0,30,1"}) == 0);
  CHECK(bad_frames({"--mask", "0,0,29,1"}) == 2);
  CHECK(bad_frames({"--mask", "0,0,15,1", "--mask", "15,0,500,1"}) == 0);
  CHECK(bad_frames({"--mask-id", "7", "--ids", ids.string()}) == 0);
  CHECK(bad_frames({"--mask-id", "0", "--ids", ids.string()}) == 2);
  const auto rules = [&](const std::string& text) { return folder.write("rules.toml", text).string(); };
  CHECK(bad_frames({"--rules", rules("[[frames]]\nframes = \"2\"\ntolerance = \"levels=90,pixels=5%\"\n")}) == 1);
  CHECK(bad_frames({"--rules", rules("[[frames]]\nframes = \"f1.png\"\nskip = true\n")}) == 1);
  CHECK(bad_frames({"--rules", rules("ids = \"ids\"\n[[mask]]\nbody = 7\n")}) == 0);
  CHECK(bad_frames({"--rules", rules("tolerance = \"levels=90,pixels=5%,cluster=1\"\n")}) == 0);
  CHECK(compare(reference, actual, {"--mask-id", "7"}).code == 2);
  CHECK(compare(reference, actual, {"--mask", "1,2,3"}).code == 2);
  CHECK(compare(reference, actual, {"--ids", (folder / "none").string(), "--mask-id", "7"}).code == 3);
  const auto mistake = [&](const std::string& text, const std::string& says) {
    const test::RunResult result = compare(reference, actual, {"--rules", rules(text)});
    INFO(result.err);
    CHECK(result.code == 2);
    CHECK(test::contains(result.err, says));
  };
  mistake("tolerence = \"same\"", "rules.toml:1:1: unknown key \"tolerence\", did you mean \"tolerance\"");
  mistake("\ntolerance = \"loose\"", "rules.toml:2:");
  mistake("[[mask]]\nrectangle = [1, 2, 3]", "rectangle");
  mistake("[[mask]]", "rectangle = [x, y, width, height] or body");
  mistake("[[frames]]\nskip = true", "says for no frame");
  mistake("[[frames]]\nframes = \"1-x\"", "rules.toml:2:");
  mistake("= 3", "rules.toml:1:");
}

TEST_CASE("A clip one frame late is told from a change, two swapped frames too, and a flicker limit holds") {
  test::TempFolder folder;
  const fs::path reference = folder / "reference", late = folder / "late", swapped = folder / "swapped",
                 flickers = folder / "flickers", darker = folder / "darker";
  for (const fs::path& f : {reference, late, swapped, flickers, darker}) fs::create_directories(f);
  for (int i = 1; i <= 12; ++i) {
    const std::string name = "frame_" + std::to_string(i) + ".png";  // not padded: 2 stands before 10
    render::write_png(reference / name, test::moving_disc(i));
    render::write_png(late / name, test::moving_disc(i - 1));
    render::write_png(swapped / name, test::moving_disc(i == 5 ? 8 : i == 8 ? 5 : i));
    render::Image other = test::moving_disc(i), dark = other;
    if (i % 2 == 0)
      for (std::uint8_t& v : other.rgba) v = static_cast<std::uint8_t>(v == 255 ? 255 : v + 2);
    for (std::uint8_t& v : dark.rgba) v = static_cast<std::uint8_t>(v == 255 ? 255 : v - 20);
    render::write_png(flickers / name, other);
    render::write_png(darker / name, dark);
  }
  const auto says = [&](const fs::path& actual, const std::string& part, std::vector<std::string> more = {}) {
    const test::RunResult result = compare(reference, actual, more);
    INFO(result.out);
    CHECK(result.code == 1);
    CHECK(test::contains(result.out, part));
    return result.out;
  };
  says(late, "the clip is 1 frame late; compared like that, 11 of 11 frames are good");
  CHECK_FALSE(test::contains(says(swapped, "swapped: frame_5.png and frame_8.png"), "shifted"));
  CHECK_FALSE(test::contains(says(darker, "12 of 12 frames differ"), "shifted"));
  CHECK(test::contains(says(darker, "first that differs: frame_1.png"), "worst: frame_"));
  const auto early = compare(late, reference);
  CHECK(test::contains(early.out, "the clip is 1 frame early"));
  const auto loose = folder.write("loose.toml", "tolerance = \"levels=2,pixels=1,cluster=1\"\n"),
             strict = folder.write("strict.toml", "tolerance = \"levels=2,pixels=1,cluster=1\"\nflicker = 1.5\n");
  CHECK(compare(reference, flickers, {"--rules", loose.string()}).code == 0);
  says(flickers, "flicker: at most 2 levels, from the frame before to frame_2.png; at most 1.5 allowed",
       {"--rules", strict.string()});
}

TEST_CASE("The JSON, the JUnit file and the page say what the terminal says, one line a frame on request") {
  test::TempFolder folder;
  const fs::path reference = folder / "reference", actual = folder / "a<&\"ctual";
  fs::create_directories(reference);
  fs::create_directories(actual);
  render::write_png(reference / "frame_0001.png", gradient(), {{"Software", "one </script>"}});
  render::write_png(actual / "frame_0001.png", gradient(), {{"Software", "two"}});
  render::write_png(reference / "frame_0002.png", gradient());
  render::write_png(actual / "frame_0002.png", changed(60, 100));
  render::write_png(actual / "frame_0003.png", gradient());
  const auto json = folder / "c.json", junit = folder / "c.xml", page = folder / "c.html";
  const auto result = compare(
      reference, actual, {"--json", json.string(), "--junit", junit.string(), "--report", page.string(), "--each"});
  INFO(result.out << result.err);
  CHECK(result.code == 1);
  CHECK(test::contains(result.out, "frame_0001.png: same pixels\n"));
  const auto told = nlohmann::json::parse(test::slurp(json));
  CHECK(told["good"] == false);
  CHECK(told["frames_that_differ"] == 2);
  CHECK(told["worst"] == "frame_0003.png");
  CHECK(told["first_that_differs"] == "frame_0002.png");
  CHECK(told["frames"][0]["reached"] == "pixels");
  CHECK(told["frames"][1]["max_levels"] == 60);
  CHECK(told["frames"][1]["differing_pixels"] == 100);
  CHECK(test::contains(told["frames"][1]["decided_by"].get<std::string>(), "60 levels"));
  CHECK(told["frames"][2]["state"] == "no reference");
  const std::string xml = test::slurp(junit), html = test::slurp(page);
  CHECK(test::contains(xml, "tests=\"3\" failures=\"2\""));
  CHECK(test::contains(xml, "a&lt;&amp;&quot;ctual"));
  CHECK(test::contains(xml, "<failure message=\"60 levels, at most 3 allowed\">"));
  CHECK(test::contains(html, "data:image/png;base64,"));
  CHECK_FALSE(test::contains(html, "one </script>"));
  CHECK_FALSE(test::contains(html, "http://localhost"));
  CHECK(compare(reference, actual, {"--json", (folder / "none/c.json").string()}).code == 5);
}

TEST_CASE(
    "--update says what changes and makes it the reference, a missing reference fails and is left beside its place") {
  test::TempFolder folder;
  const fs::path reference = folder / "reference", actual = folder / "actual";
  fs::create_directories(actual);
  for (const char* name : {"f1.png", "f2.png"}) render::write_png(actual / name, gradient());
  const auto missing = compare(reference, actual);
  CHECK(missing.code == 1);
  CHECK(fs::exists(reference / "f1.actual.png"));
  CHECK_FALSE(fs::exists(reference / "f1.png"));
  const auto made = compare(reference, actual, {"--update"});
  INFO(made.out << made.err);
  CHECK(made.code == 0);
  CHECK_FALSE(fs::exists(reference / "f1.actual.png"));
  CHECK(compare(reference, actual).code == 0);
  render::write_png(actual / "f2.png", changed(50, 50));
  const std::string before = test::slurp(reference / "f1.png");
  const auto updated = compare(reference, actual, {"--update"});
  INFO(updated.out);
  CHECK(test::contains(updated.out, "f2.png: different"));
  CHECK(updated.out.find("f2.png: different") < updated.out.find("updated: "));
  CHECK(test::contains(updated.out, "1 reference updated"));
  CHECK(test::slurp(reference / "f2.png") == test::slurp(actual / "f2.png"));
  CHECK(test::slurp(reference / "f1.png") == before);
  const auto single = folder / "new/picture.png";
  CHECK(compare(single, actual / "f1.png").code == 1);
  CHECK(fs::exists(folder / "new/picture.actual.png"));
  CHECK(compare(single, actual / "f1.png", {"--update"}).code == 0);
  CHECK(compare(single, actual / "f1.png").code == 0);
}
