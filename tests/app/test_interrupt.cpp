// Ctrl-C, kill and kill -9 at any moment: complete files only, and the same command goes on to the same bits.
#include <signal.h>

#include <random>
#include <thread>

#include "assets/export_pc2.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

/// Long enough to be caught in the act: 40 frames.
std::vector<std::string> longer(const std::string& command, const std::string& scene,
                                const std::filesystem::path& out) {
  return {command, scene, "-o", out.string(), "--set", "time.duration=1.3333"};
}

}  // namespace

TEST_CASE("Ctrl-C leaves complete frames, says how to go on, and the same command does") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  const auto reference = folder / "reference", out = folder / "out";
  REQUIRE(test::run(longer("render", scene, reference)).code == 0);
  const auto interrupt = [&](const char* command, int signal, auto&& in_the_act) {
    test::Running program(longer(command, scene, out));
    REQUIRE(program.wait_for(in_the_act));
    program.send(signal);
    const test::RunResult result = program.wait();
    INFO(result.err);
    CHECK(result.code == 130);
    CHECK(test::contains(result.err, "interrupted"));
    CHECK(test::contains(result.err, "the same command goes on"));
    test::check_only_whole_files(out);
  };
  interrupt("simulate", SIGINT, [&] { return test::states_in(out).size() >= 3; });
  const std::size_t simulated = test::states_in(out).size();
  CHECK(simulated < 40);
  interrupt("simulate", SIGTERM, [&] { return test::states_in(out).size() >= simulated + 3; });
  interrupt("render", SIGINT, [&] { return test::pictures_in(out).size() >= 3; });
  CHECK(test::pictures_in(out).size() < 40);
  CHECK(test::run(longer("render", scene, out)).code == 0);
  CHECK(test::pictures_in(out) == test::pictures_in(reference));
  CHECK(test::states_in(out) == test::states_in(reference));
}

TEST_CASE("A render that is killed at any moment ends, run again, with the bits of an undisturbed one") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  const auto reference = folder / "reference", out = folder / "out";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(test::run(longer("render", scene, reference)).code == 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(2024);
  std::uniform_real_distribution<double> moment(0.0, 0.6);
  int killed = 0, runs = 0;
  for (; killed < 10 && runs < 50; ++runs) {
    test::Running program(longer("render", scene, out));
    std::this_thread::sleep_for(moment(random) * whole);
    const bool at_work = !program.ended();
    program.send(SIGKILL);
    program.wait();
    if (at_work)
      ++killed;
    else
      std::filesystem::remove_all(out);  // it came to its end: once more from the beginning
  }
  MESSAGE(killed << " of " << runs << " runs were killed at work");
  CHECK(killed == 10);
  CHECK(test::run(longer("render", scene, out)).code == 0);
  CHECK(test::pictures_in(out) == test::pictures_in(reference));
  CHECK(test::states_in(out) == test::states_in(reference));
}

TEST_CASE("A killed worker is a bad input with a reason, and Ctrl-C ends one at once") {
  test::TempFolder folder;
  const auto ball = test::sphere(7);  // 131,072 faces: the import takes a while
  assets::write_obj(folder / "ball.obj", ball.vertices, ball.triangles);
  const std::vector<std::string> command = {"tetrahedralize", (folder / "ball.obj").string(), "-o",
                                            (folder / "ball.msh").string()};
  {
    test::Running program(command);
    REQUIRE(program.wait_for([&] { return !test::children_of(program.pid()).empty(); }));
    for (const int child : test::children_of(program.pid())) ::kill(child, SIGKILL);
    const test::RunResult result = program.wait();
    INFO(result.err);
    CHECK(result.code == 3);
    CHECK(test::contains(result.err, "was killed"));
    CHECK(folder.files() == 1);
  }
  {
    test::Running program(command);
    std::vector<int> children;
    REQUIRE(program.wait_for([&] { return !(children = test::children_of(program.pid())).empty(); }));
    program.send(SIGINT);
    const test::RunResult result = program.wait();
    CHECK(result.code == 130);
    CHECK(folder.files() == 1);
    for (const int child : children) CHECK(::kill(child, 0) != 0);
  }
}

TEST_CASE("A run that ignores interruptions from the start goes on ignoring them") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  test::RunOptions nohup;
  nohup.ignore_interrupts = true;
  test::Running program(longer("simulate", scene, folder / "out"), nohup);
  REQUIRE(program.wait_for([&] { return test::states_in(folder / "out").size() >= 2; }));
  program.send(SIGINT);
  CHECK(program.wait().code == 0);
}
