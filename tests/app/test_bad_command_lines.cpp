// Command lines that make no sense: exit code 2 and a sentence, and nothing is written.
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;

TEST_CASE("Command lines that make no sense are refused") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  const std::string mesh = folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  const std::string picture = folder.write("picture.jpg", "not yet").string();
  const std::string out = (folder / "out").string();
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"render", scene, "-o", out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::vector<test::BadInput> table = {
      {"no command", {}, 2, {"command"}},
      {"unknown command", {"rendr", scene}, 2, {"rendr"}},
      {"no scene", {"render"}, 2, {"scene"}},
      {"two scenes", {"render", scene, scene}, 2, {scene}},
      {"unknown option", render({"--fast"}), 2, {"--fast"}},
      {"option without its value", render({"--frames"}), 2, {"--frames"}},
      {"frames that are no numbers", render({"--frames", "all"}), 2, {"--frames", "'all'"}},
      {"frame 0", render({"--frames", "0-3"}), 2, {"first frame"}},
      {"frames behind the end", render({"--frames", "1-700"}), 2, {"last frame, 6"}},
      {"frames backwards", render({"--frames", "5-2"}), 2, {"ends before it begins"}},
      {"comma at the end", render({"--frames", "1,"}), 2, {"comma"}},
      {"a frame number beyond counting", render({"--frames", "99999999999999999999"}), 2, {"not a number"}},
      {"step 0", render({"--frames", "1-4x0"}), 2, {"--frames"}},
      {"--set without a value", render({"--set", "render.samples"}), 2, {"render.samples"}},
      {"--set of an unknown key", render({"--set", "render.smaples=4"}), 2, {"smaples", "samples"}},
      {"--set of an unknown body", render({"--set", "cloth.shet.density=4"}), 2, {"shet"}},
      {"--set out of range", render({"--set", "cloth.sheet.density=-4"}), 2, {"density"}},
      {"no threads", render({"--threads", "0"}), 2, {"--threads"}},
      {"threads that are no number", render({"--threads", "many"}), 2, {"--threads"}},
      {"video of an unknown kind", render({"--video", out + "/clip.gif"}), 2, {".gif", ".mp4"}},
      {"video without an extension", render({"--video", "clip"}), 2, {".mp4"}},
      {"export of an unknown kind", {"simulate", scene, "--export", "abc"}, 2, {"abc", "vtu"}},
      {"check without a scene", {"check"}, 2, {"--list"}},
      {"one picture to compare", {"compare", picture}, 2, {"actual"}},
      {"a picture and a folder", {"compare", picture, folder.path().string()}, 2, {"not a picture and a folder"}},
      {"unknown tolerance", {"compare", picture, picture, "--tolerance", "some"}, 2, {"some"}},
      {"no pictures in a turn", {"turntable", mesh, "-o", out, "--count", "0"}, 2, {"--count"}},
      {"turntable of 100,000 pixels", {"turntable", mesh, "-o", out, "--size", "100000", "10"}, 2, {"--size"}},
      {"turntable of an unknown colour", {"turntable", mesh, "-o", out, "--color", "blurple"}, 2, {"blurple"}},
      {"tetrahedra without a file to write", {"tetrahedralize", mesh}, 2, {"--output"}},
      {"tetrahedra into an unknown format", {"tetrahedralize", mesh, "-o", out + ".stl"}, 2, {".stl", ".msh"}},
      {"quality that TetGen cannot give",
       {"tetrahedralize", mesh, "-o", out + ".msh", "--quality", "0.5"},
       2,
       {"--quality"}},
      {"negative volume", {"tetrahedralize", mesh, "-o", out + ".msh", "--max-volume", "-1"}, 2, {"--max-volume"}},
  };
  for (const test::BadInput& bad : table) test::check_refused(bad);
  CHECK(test::pictures_in(folder / "out").empty());
  test::check_only_whole_files(folder.path());
}

TEST_CASE("Without ffmpeg a video is refused before any work, and frames are not") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  const std::string mesh = folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  const std::string out = (folder / "out").string();
  test::RunOptions nowhere;
  nowhere.environment = {{"PATH", ""}};
  test::check_refused({"render", {"render", scene, "-o", out, "--video", out + "/a.mp4"}, 3, {"ffmpeg", "PATH"}},
                      nowhere);
  test::check_refused({"turntable", {"turntable", mesh, "-o", out, "--video", out + "/a.mp4"}, 3, {"ffmpeg"}}, nowhere);
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(test::run({"render", scene, "-o", out}, nowhere).code == 0);
  CHECK(test::pictures_in(out).size() == 6);
}
