// What the program tells: versions, help, lists, progress, stats.
#include "tests/app/clip.h"

using namespace softreel;

TEST_CASE("--version names the program and its libraries") {
  const test::RunResult result = test::run({"--version"});
  CHECK(result.code == 0);
  for (const char* name : {"softreel ", "OSMesa", "llvmpipe", "Eigen 3.4", "CHOLMOD", "assimp 5.2", "TetGen", "toml++",
                           "GLM", "gnuplot /"}) {
    INFO(name);
    std::string flat = result.out;
    for (std::size_t at; (at = flat.find("  ")) != std::string::npos;) flat.erase(at, 1);
    CHECK(test::contains(flat, name));
  }
}

TEST_CASE("--help has examples and the exit codes, every command has its own help") {
  const test::RunResult all = test::run({"--help"});
  CHECK(all.code == 0);
  CHECK(test::contains(all.out, "Examples:"));
  CHECK(test::contains(all.out, "130 interrupted"));
  for (const char* command : {"render", "simulate", "turntable", "compare", "check", "study", "tetrahedralize"}) {
    INFO(command);
    CHECK(test::contains(all.out, command));
    const test::RunResult one = test::run({command, "--help"});
    CHECK(one.code == 0);
    CHECK(test::contains(one.out, "--threads"));
    CHECK(one.err.empty());
  }
}

TEST_CASE("check --list names every section, key and choice") {
  const test::RunResult result = test::run({"check", "--list"});
  CHECK(result.code == 0);
  for (const char* name : {"substeps", "stable-neo-hookean", "corotated-volume", "mass-spring", "implicit-euler",
                           "symplectic-euler", "cholesky", "friction", "max_volume", "rubber", "samples"}) {
    INFO(name);
    CHECK(test::contains(result.out, name));
  }
}

TEST_CASE("check validates without making anything") {
  test::TempFolder folder;
  folder.write("scene.toml", test::small_scene());
  test::RunOptions inside;
  inside.folder = folder.path();
  const test::RunResult result = test::run({"check", "scene.toml"}, inside);
  CHECK(result.code == 0);
  CHECK(test::contains(result.out, "8 frames at 30 fps, 14 steps"));
  CHECK(test::files_below(folder.path()).size() == 1);
}

TEST_CASE("The stats have the documented keys, and their figures fit together") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  const nlohmann::json stats = test::stats_of({"render", scene, "-o", (folder / "out").string()}, folder);
  for (const char* key : {"scene", "sim_hash", "needs", "left_out", "solver", "vertices", "triangles", "tets", "frames",
                          "steps", "newton_iterations", "linear_iterations", "retried_steps", "seconds",
                          "simulate_seconds", "peak_memory_bytes", "energy"}) {
    INFO(key);
    CHECK(stats.contains(key));
  }
  CHECK(stats.at("scene") == scene);
  CHECK(stats.at("frames") == 8);
  CHECK(stats.at("frames_rendered") == 8);
  CHECK(stats.at("steps") == 14);
  CHECK(stats.at("vertices") == 81 + 27);
  CHECK(stats.at("triangles") == 128 + 48);
  CHECK(stats.at("newton_iterations") >= 14);
  CHECK(stats.at("peak_memory_bytes") > 1 << 20);
  for (const char* stage : {"load", "simulate", "render", "encode", "total"}) CHECK(stats.at("seconds").at(stage) > 0);
  double parts = 0;
  for (const auto& [name, seconds] : stats.at("simulate_seconds").items()) parts += seconds.get<double>();
  CHECK(parts == doctest::Approx(stats.at("seconds").at("simulate").get<double>()));
  for (const char* kind : {"kinetic", "elastic", "gravity", "contact", "dissipated"})
    CHECK(stats.at("energy").at(kind).size() == 8);
  CHECK(stats.at("energy").at("kinetic").at(0) == 0);
  CHECK(stats.at("energy").at("gravity").at(7) < stats.at("energy").at("gravity").at(0));
}

TEST_CASE("Progress is plain lines on stderr, results go to stdout, and --quiet says nothing") {
  test::TempFolder folder;
  folder.write("clip.toml", test::hanging_cloth());
  test::RunOptions inside;
  inside.folder = folder.path();
  const test::RunResult loud = test::run({"render", "clip.toml"}, inside);  // into out/clip
  CHECK(loud.code == 0);
  CHECK(loud.out == "out/clip/frame_0001.png\nout/clip/frame_0006.png\n");
  CHECK(test::contains(loud.err, "render 6/6"));
  CHECK(loud.err.find('\r') == std::string::npos);
  CHECK(test::contains(test::run({"render", "clip.toml"}, inside).err, "up to date"));
  for (const char* samples : {"1", "3"}) {
    const test::RunResult quiet =
        test::run({"render", "clip.toml", "--quiet", "--set", std::string("render.samples=") + samples}, inside);
    CHECK(quiet.code == 0);
    CHECK(quiet.err.empty());
    CHECK(quiet.out.empty());
  }
}
