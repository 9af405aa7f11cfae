// What a scene may ask of its pictures, seen from outside: blur, side channels, data, patterns, backgrounds, sheets;
// and scenes whose light or camera makes little sense.
#include <cmath>

#include "assets/atomic_file.h"
#include "render/image_io.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

/// A block that is thrown to the right, seen from in front; two frames.
std::string thrown(const std::string& more = "", const std::string& look = "") {
  return "[time]\nduration = 0.2\nfps = 10\nsubsteps = 1\n[[soft]]\nname = \"block\"\nblock = { size = [0.4, 0.4, "
         "0.4], "
         "cells = [2, 2, 2] }\nvelocity = [4, 0, 0]\n" +
         look +
         "[camera]\nposition = [0.2, 0, 3]\ntarget = [0.2, 0, 0]\n[[light]]\nkind = \"sun\"\n[render]\nsize = [64, "
         "48]\nsamples = 16\nground = { show = \"off\" }\n" +
         more;
}

std::filesystem::path pictures_of(const test::TempFolder& folder, const std::string& name, const std::string& scene,
                                  std::vector<std::string> more = {}) {
  folder.write(name + ".toml", scene);
  std::vector<std::string> arguments = {"render", (folder / (name + ".toml")).string(), "-o", (folder / name).string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const test::RunResult result = test::run(arguments);
  INFO(name, ": ", result.err);
  REQUIRE(result.code == 0);
  return folder / name;
}

render::Image frame(const std::filesystem::path& folder, const char* file = "frame_0002.png") {
  return render::load_image(folder / file);
}

/// Columns in the middle row whose pixels are neither background nor the body's full cover.
int columns_unlike(const render::Image& image, const std::uint8_t* pixel) {
  int count = 0;
  for (int x = 0; x < image.width; ++x) {
    int apart = 0;
    for (int c = 0; c < 4; ++c) apart = std::max(apart, std::abs(image.pixel(x, image.height / 2)[c] - pixel[c]));
    count += apart > 8;
  }
  return count;
}

}  // namespace

TEST_CASE("The shutter smears what moves, leaves the first frame alone, and is not simulated again") {
  const test::TempFolder folder;
  const auto out = pictures_of(folder, "clip", thrown());
  const render::Image sharp = frame(out), first = frame(out, "frame_0001.png");
  folder.write("clip.toml", thrown("shutter = 1\n"));
  const auto stats = test::stats_of({"render", (folder / "clip.toml").string(), "-o", out.string()}, folder);
  CHECK(stats["frames_simulated"] == 0);
  CHECK(frame(out, "frame_0001.png").rgba == first.rgba);
  const render::Image blurred = frame(out);
  // 0.4 m of way are as long as the block: what is covered at some time is twice as wide.
  const int narrow = columns_unlike(sharp, sharp.pixel(0, 24)), wide = columns_unlike(blurred, blurred.pixel(0, 24));
  CHECK(narrow > 5);
  CHECK(wide > 1.6 * narrow);
}

TEST_CASE("samples = auto reports samples and error of each frame and meets its tolerance") {
  const test::TempFolder folder;
  folder.write("clip.toml", thrown());
  const auto stats = test::stats_of({"render", (folder / "clip.toml").string(), "-o", (folder / "out").string(),
                                     "--set", "render.samples=auto", "--set", "render.tolerance=1"},
                                    folder);
  REQUIRE(stats["picture"]["samples"].size() == 2);
  for (const auto& error : stats["picture"]["error_levels"]) CHECK(error.get<double>() <= 1);
  for (const auto& samples : stats["picture"]["samples"]) CHECK(samples.get<int>() >= 8);
}

TEST_CASE("Side channels hold distance, normal and number of what is seen") {
  const test::TempFolder folder;
  const auto out = pictures_of(folder, "clip", thrown("depth = true\nnormal = true\nid = true\n"), {"--frames", "1"});
  // load_image keeps the upper 8 of 16 bits. The block's face is 2.8 m away: 2800 mm = 10 x 256 + 240.
  const int x = 28, y = 24;  // at the world's origin, 0.2 m to the left of the middle
  CHECK(render::load_image(out / "depth_0001.png").pixel(x, y)[0] == 10);
  CHECK(render::load_image(out / "depth_0001.png").pixel(0, 0)[0] == 255);
  const std::uint8_t* normal = render::load_image(out / "normal_0001.png").pixel(x, y);
  CHECK(std::abs(normal[0] - 128) <= 1);
  CHECK(render::load_image(out / "normal_0001.png").pixel(x, y)[2] >= 250);
  CHECK(render::load_image(out / "id_0001.png").pixel(x, y)[0] == 0);  // 2 of 65535
}

TEST_CASE("A speed colours a body with the very colours of its bar, and the range is the clip's") {
  const test::TempFolder folder;
  // Thrown without gravity the block moves at 4 m/s everywhere, in the middle between 0 and 8.
  const std::string scene = "gravity = [0, 0, 0]\n" +
                            thrown("", "data = { show = \"speed\", range = [0, 8], shading = 0, colorbar = false }\n");
  const render::Image image = frame(pictures_of(folder, "clip", scene));
  const std::uint8_t* p = image.pixel(28 + 8, 24);
  // viridis at 0.5: #21918c
  CHECK(std::abs(p[0] - 0x21) <= 2);
  CHECK(std::abs(p[1] - 0x91) <= 2);
  CHECK(std::abs(p[2] - 0x8c) <= 2);
}

TEST_CASE("A pattern sticks to the body, wire shows its triangles, and both leave the simulation alone") {
  const test::TempFolder folder;
  const std::string
      plain = "look = { color = \"#204080\" }\n",
      checked =
          "look = { color = \"#204080\", pattern = \"checker\", pattern_color = \"#f0f0f0\", pattern_size = 0.1 }\n",
      wired = "look = { color = \"#204080\", wire = \"#ffffff\" }\n";
  const auto out = pictures_of(folder, "clip", thrown("", plain), {"--frames", "1"});
  const render::Image before = frame(out, "frame_0001.png");
  for (const std::string& look : {checked, wired}) {
    folder.write("clip.toml", thrown("", look));
    const auto stats =
        test::stats_of({"render", (folder / "clip.toml").string(), "-o", out.string(), "--frames", "1"}, folder);
    CHECK(stats["frames_simulated"] == 0);
    const render::Image after = frame(out, "frame_0001.png");
    int brighter = 0;
    for (std::size_t i = 0; i < after.rgba.size(); i += 4) brighter += after.rgba[i] > before.rgba[i] + 60;
    CHECK(brighter > 20);
  }
}

TEST_CASE("A transparent background lays over any other as if it had been drawn there") {
  const test::TempFolder folder;
  const std::string ground = "ground = { show = \"shadow\", height = -0.2 }\n";
  std::string scene = thrown();
  scene.replace(scene.find("ground = { show = \"off\" }\n"), 26, ground);
  const std::string grey = "background = { top = \"#808080\", bottom = \"#808080\" }\n";
  const render::Image over = frame(pictures_of(folder, "grey", scene + grey), "frame_0001.png");
  const render::Image clear =
      frame(pictures_of(folder, "clear", scene + "background = { transparent = true }\n"), "frame_0001.png");
  int shadowed = 0;
  for (std::size_t i = 0; i < over.rgba.size(); i += 4) {
    const int alpha = clear.rgba[i + 3];
    // Only where nothing is drawn, or everything, are sums in sRGB those in light; there they have to be right.
    if (alpha == 0) CHECK(over.rgba[i] == 0x80);
    if (alpha == 255) CHECK(std::abs(over.rgba[i] - clear.rgba[i]) <= 1);
    shadowed += alpha > 20 && alpha < 235 && clear.rgba[i] == 0 && clear.rgba[i + 1] == 0;
  }
  CHECK(shadowed > 0);  // there is a shadow, and it is neither all nor nothing
}

TEST_CASE("A contact sheet holds the frames with their times, and a turntable takes a scene") {
  const test::TempFolder folder;
  const auto out = pictures_of(folder, "clip", thrown(), {"--sheet"});
  const render::Image sheet = render::load_image(out / "sheet.png");
  CHECK(sheet.width == 8 + 2 * (64 + 8));
  CHECK(sheet.height == 8 + 48 + 20 + 8);
  CHECK(std::equal(sheet.pixel(8, 8), sheet.pixel(8, 8) + 3, frame(out, "frame_0001.png").pixel(0, 0)));
  const test::RunResult turned =
      test::run({"turntable", (folder / "clip.toml").string(), "-o", (folder / "spin").string(), "--count", "2",
                 "--size", "48", "32", "--samples", "1", "--frame", "1"});
  INFO(turned.err);
  CHECK(turned.code == 0);
  CHECK(render::load_image(folder / "spin" / "frame_0002.png").width == 48);
  CHECK(test::run({"turntable", (folder / "clip.toml").string(), "--frame", "9"}).code == 2);
}

TEST_CASE("The camera goes along its keys, round its target and with a body") {
  const test::TempFolder folder;
  const render::Image still = frame(pictures_of(folder, "still", thrown()));
  std::string scene = thrown();
  const std::string at = "target = [0.2, 0, 0]\n";
  const auto with = [&](const std::string& name, const std::string& keys) {
    std::string text = scene;
    text.insert(text.find(at) + at.size(), keys);
    return frame(pictures_of(folder, name, text));
  };
  // Two keys that both say what the camera says: nothing changes.
  CHECK(with("same", "keys = [{ t = 0, position = [0.2, 0, 3] }, { t = 1, position = [0.2, 0, 3] }]\n").rgba ==
        still.rgba);
  CHECK(with("keyed", "keys = [{ t = 0 }, { t = 0.1, position = [0.2, 1, 3] }]\n").rgba != still.rgba);
  CHECK(with("orbit", "orbit = 90\n").rgba != still.rgba);
  // Followed, the block stays where it was in frame 1 but for its fall.
  const render::Image followed = with("follow", "follow = \"block\"\n");
  CHECK(columns_unlike(followed, followed.pixel(0, 0)) > 0);
  folder.write("who.toml", scene + "\n");
  CHECK(test::run({"check", (folder / "who.toml").string(), "--set", "camera.follow=nobody"}).code == 2);
}

TEST_CASE(
    "Scenes without light, with the camera or the light inside a body come out as pictures, one without bodies is "
    "refused") {
  const test::TempFolder folder;
  // The sum of the colours in the middle of the only picture.
  const auto middle = [](const std::filesystem::path& out) {
    const render::Image image = frame(out, "frame_0001.png");
    const std::uint8_t* pixel = image.pixel(image.width / 2, image.height / 2);
    return pixel[0] + pixel[1] + pixel[2];
  };
  // No light at all: what is there is black, and the background is as asked for.
  const auto dark = pictures_of(
      folder, "dark",
      "light = []\n[[cloth]]\ngrid = { size = [1, 1], cells = [2, 2] }\n[time]\nduration = 0.03\n[render]\nsize = "
      "[32, 24]\nsky = 0\nbackground = \"white\"\nground = \"off\"\n");
  CHECK(middle(dark) == 0);
  CHECK(int(frame(dark, "frame_0001.png").pixel(0, 0)[0]) == 245);  // "white" is #f5f5f5
  // Without anything that moves there is no clip, which is said.
  const std::string empty =
      folder.write("empty.toml", "[[collider]]\nshape = \"plane\"\n[render]\nsize = [32, 24]\n").string();
  const test::RunResult refused = test::run({"render", empty, "-o", (folder / "empty").string()});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("there is nothing to simulate") != std::string::npos);
  // From inside a solid its faces are seen from behind, so it is not there: the picture is the background.
  std::string inside = thrown();
  inside.replace(inside.find("position = [0.2, 0, 3]"), 22, "position = [0.0, 0, 0.05]");
  const render::Image seen = frame(pictures_of(folder, "inside", inside, {"--frames", "1"}), "frame_0001.png");
  CHECK(int(seen.pixel(0, 12)[0]) == int(seen.pixel(32, 12)[0]));
  // A light inside a body lights nothing outside of it; the sky does.
  std::string lit = thrown();
  lit.replace(lit.find("kind = \"sun\""), 12, "position = [0, 0, 0]\nradius = 0.05");
  std::string unlit = thrown();
  unlit.replace(unlit.find("kind = \"sun\""), 12, "intensity = 0");
  CHECK(std::abs(middle(pictures_of(folder, "lit", lit, {"--frames", "1"})) -
                 middle(pictures_of(folder, "unlit", unlit, {"--frames", "1"}))) <= 3);
}

TEST_CASE("study --render measures samples and presets by RMS and FLIP, and both fall with the samples") {
  const test::TempFolder folder;
  std::string text = thrown();
  text.insert(text.find("kind = \"sun\""), "shadow = false\n");  // two thousand passes, each without a map
  const std::string scene = folder.write("clip.toml", text).string();
  const test::RunResult result =
      test::run({"study", scene, "--render", "-o", (folder / "out").string(), "--set", "render.size=[32, 24]", "--set",
                 "render.sky_shadow=false", "--repeats", "1"});
  INFO(result.err);
  REQUIRE(result.code == 0);
  const nlohmann::json study = nlohmann::json::parse(assets::read_file(folder / "out" / "pictures.json"));
  const nlohmann::json& rows = study["rows"];
  REQUIRE(rows.size() == 12);  // 1, 2, 4, ..., 256, and three presets
  CHECK(rows[0]["samples"] == 1);
  CHECK(rows[8]["samples"] == 256);
  for (const char* error : {"rms_levels", "flip"}) {
    CHECK(rows[8][error] > 0);
    CHECK(rows[4][error] < rows[0][error]);
    CHECK(rows[8][error] < rows[4][error]);
    CHECK(rows[10][error] == rows[4][error]);  // the preset default is 16 samples
  }
  CHECK(rows[9]["preset"] == "draft");
  CHECK(rows[11]["preset"] == "final");
  CHECK(result.out.find("FLIP") != std::string::npos);
  CHECK(assets::read_file(folder / "out" / "pictures.csv").starts_with("samples,preset,seconds,rms_levels,flip\n1,,"));
}
