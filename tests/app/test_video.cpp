// Videos: what ffprobe says of them.
#include <signal.h>

#include <cstdio>

#include "assets/export_pc2.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

std::string ffprobe(const std::filesystem::path& video) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
      "stream=codec_name,pix_fmt,width,height,nb_read_frames,avg_frame_rate -of default=noprint_wrappers=1 'file:" +
      video.string() + "' 2>&1";
  std::string text;
  FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe);
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) text += buffer;
  ::pclose(pipe);
  return text;
}

bool has_ffmpeg() {
  const int ffmpeg = std::system("ffmpeg -version > /dev/null 2>&1 && ffprobe -version > /dev/null 2>&1");
  if (ffmpeg != 0) MESSAGE("skipped: there is no ffmpeg here");
  return ffmpeg == 0;
}

void check_video(const std::filesystem::path& video, int width, int height, int frames, const std::string& rate) {
  const std::string text = ffprobe(video);
  INFO(video.string() << ":\n" << text);
  CHECK(test::contains(text, "codec_name=h264\n"));
  CHECK(test::contains(text, "pix_fmt=yuv420p\n"));
  CHECK(test::contains(text, "width=" + std::to_string(width) + "\n"));
  CHECK(test::contains(text, "height=" + std::to_string(height) + "\n"));
  CHECK(test::contains(text, "nb_read_frames=" + std::to_string(frames) + "\n"));
  CHECK(test::contains(text, "avg_frame_rate=" + rate + "\n"));
}

std::string scene_in(const test::TempFolder& folder) {
  return folder.write("scene.toml", test::hanging_cloth()).string();
}

}  // namespace

TEST_CASE("A rendered clip becomes a video that plays everywhere") {
  if (!has_ffmpeg()) return;
  test::TempFolder folder;
  const std::string scene = scene_in(folder), out = (folder / "out").string();
  for (const char* name : {"clip.mp4", "clip.mov", "clip.m4v", "clip.mkv"}) {
    const auto video = folder / name;
    const test::RunResult result = test::run({"render", scene, "-o", out, "--video", video.string()});
    INFO(result.err);
    CHECK(result.code == 0);
    CHECK(test::contains(result.out, video.string()));
    check_video(video, 48, 32, 6, "30/1");
  }
  // Its index comes first, so that it starts to play before it is loaded.
  const std::string bytes = test::slurp(folder / "clip.mp4");
  CHECK(bytes.find("moov") < bytes.find("mdat"));
  test::check_only_whole_files(folder.path());
}

TEST_CASE("A video of some frames has these, with the clip's rate") {
  if (!has_ffmpeg()) return;
  test::TempFolder folder;
  const auto video = folder / "clip.mp4";
  CHECK(test::run({"render", scene_in(folder), "-o", (folder / "out").string(), "--frames", "2-6x2", "--video",
                   video.string(), "--set", "time.fps=25", "--set", "time.duration=0.24"})
            .code == 0);
  check_video(video, 48, 32, 3, "25/1");
}

TEST_CASE("Pictures of odd and of tiny sizes become videos too") {
  if (!has_ffmpeg()) return;
  test::TempFolder folder;
  const std::string scene = scene_in(folder);
  const std::vector<std::tuple<std::string, int, int>> sizes = {{"[49,33]", 48, 32}, {"[3,1]", 2, 2}, {"[1,1]", 2, 2}};
  for (const auto& [size, width, height] : sizes) {
    INFO(size);
    const auto video = folder / "clip.mp4";
    const test::RunResult result = test::run({"render", scene, "-o", (folder / "out").string(), "--video",
                                              video.string(), "--set", "render.size=" + size, "--frames", "1-3"});
    INFO(result.err);
    CHECK(result.code == 0);
    check_video(video, width, height, 3, "30/1");
  }
}

TEST_CASE("A turntable video has as many frames as pictures") {
  if (!has_ffmpeg()) return;
  test::TempFolder folder;
  const auto ball = test::cube();
  assets::write_obj(folder / "cube.obj", ball.vertices, ball.triangles);
  const auto video = folder / "videos/spin.mp4";  // the folder is made
  const test::RunResult result =
      test::run({"turntable", (folder / "cube.obj").string(), "-o", (folder / "out").string(), "--count", "5", "--size",
                 "65", "49", "--samples", "1", "--fps", "12", "--video", video.string()});
  INFO(result.err);
  CHECK(result.code == 0);
  CHECK(test::pictures_in(folder / "out").size() == 5);
  check_video(video, 64, 48, 5, "12/1");
}

TEST_CASE("Names with blanks, colons, quotes, percent signs, umlauts and a leading dash work for everything") {
  test::TempFolder folder;
  for (const std::string name : {"two words", "a:b", "100%d", "büst", "-dash", "it's", "\xff\xfe", "$(x)"}) {
    INFO(name);
    std::filesystem::create_directories(folder / name);
    folder.write(name + "/" + name + ".toml", test::hanging_cloth());
    test::RunOptions inside;
    inside.folder = folder / name;
    std::vector<std::string> arguments = {"render", "--frames", "1-2", "--stats=" + name + ".json"};
    if (has_ffmpeg()) arguments.push_back("--video=" + name + ".mp4");
    arguments.insert(arguments.end(), {"--", name + ".toml"});
    const test::RunResult result = test::run(arguments, inside);
    INFO(result.err);
    CHECK(result.code == 0);
    CHECK(test::pictures_in(folder / name / "out" / name).size() == 2);
    CHECK(std::filesystem::exists(folder / name / (name + ".json")));
    CHECK(std::filesystem::exists(folder / name / (name + ".mp4")) == has_ffmpeg());
    test::check_only_whole_files(folder / name);
  }
}

TEST_CASE("An ffmpeg that fails is an error with its words, one that hangs does not hold up Ctrl-C") {
  test::TempFolder folder;
  const std::string scene = scene_in(folder), out = (folder / "out").string();
  REQUIRE(test::run({"render", scene, "-o", out}).code == 0);
  const auto frames = test::pictures_in(out);
  const std::vector<std::string> command = {"render", scene, "-o", out, "--video", (folder / "clip.mp4").string()};
  const auto pretend = [&](const std::string& script) {
    const auto program = folder.write("ffmpeg", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  };
  test::RunOptions options;
  options.environment = {{"PATH", folder.path().string() + ":/usr/bin:/bin"}};
  for (const std::string script : {"echo no such encoder >&2; exit 7", "exec <&-; echo no such encoder >&2; exit 7"}) {
    pretend(script);
    const test::RunResult failed = test::run(command, options);
    INFO(failed.err);
    CHECK(failed.code == 5);
    CHECK(test::contains(failed.err, "no such encoder"));
    CHECK(test::contains(failed.err, "exit code 7"));
  }
  pretend("touch " + (folder / "started").string() + "; exec sleep 200");
  test::Running hanging(command, options);
  REQUIRE(hanging.wait_for([&] { return std::filesystem::exists(folder / "started"); }));
  hanging.send(SIGINT);
  const test::RunResult result = hanging.wait();
  CHECK(result.in_time);
  CHECK(result.code == 130);
  CHECK(test::pictures_in(out) == frames);
  CHECK_FALSE(std::filesystem::exists(folder / "clip.mp4"));
}
