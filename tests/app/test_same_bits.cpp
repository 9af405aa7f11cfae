// The promise: on one machine the same scene gives the same bits, for any number of threads and after a resume.
#include "tests/app/clip.h"

using namespace softreel;

TEST_CASE("Two runs, one and two threads, and a resumed run give the same pictures and states") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  const auto render = [&](const std::string& name, const std::vector<std::vector<std::string>>& runs) {
    for (const std::vector<std::string>& more : runs) {
      std::vector<std::string> arguments = {"render", scene, "-o", (folder / name).string()};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const test::RunResult result = test::run(arguments);
      INFO(result.err);
      REQUIRE(result.code == 0);
    }
    return std::pair(test::pictures_in(folder / name), test::states_in(folder / name));
  };
  const auto one = render("one", {{"--threads", "1"}});
  CHECK(one.first.size() == 8);
  CHECK(one.second.size() == 8);
  CHECK(render("again", {{"--threads", "1"}}) == one);
  CHECK(render("two", {{"--threads", "2"}}) == one);
  CHECK(render("three", {{"--threads", "3"}}) == one);
  std::filesystem::create_directories(folder / "resumed");
  REQUIRE(test::run({"simulate", scene, "-o", (folder / "resumed").string(), "--frames", "1-3"}).code == 0);
  CHECK(test::states_in(folder / "resumed").size() == 3);
  CHECK(render("resumed", {{"--threads", "2"}}) == one);
}

TEST_CASE("Meshes large enough for several threads give the same bits for any number of them") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  const auto simulate = [&](const std::string& threads, std::vector<std::string> more) {
    const auto out = folder / ("out" + threads);
    more.insert(more.begin(),
                {"simulate", scene, "-o", out.string(), "--threads", threads, "--set", "cloth.sheet.grid.cells=[46,46]",
                 "--set", "soft.block.block.cells=[9,9,9]", "--set", "soft.block.translate=[0,0.1005,0]"});
    const test::RunResult result = test::run(more);
    INFO(result.err);
    REQUIRE(result.code == 0);
    return test::states_in(out);
  };
  const std::vector<std::vector<std::string>> methods = {
      {"--frames", "1-3"},
      {"--frames", "1-3", "--set", "solver.linear=cg", "--set", "cloth.sheet.material.young=2e4"},
      {"--frames", "1-2", "--set", "time.integrator=symplectic-euler", "--set", "time.substeps=400", "--set",
       "soft.block.translate=[0,0.2,0]"}};
  for (const auto& method : methods) {
    INFO(method.back());
    const auto one = simulate("1", method);
    CHECK(one.size() >= 2);
    CHECK(simulate("2", method) == one);
    CHECK(simulate("5", method) == one);
  }
}
