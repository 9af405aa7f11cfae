// The map of stability over two keys: what it measures, what it writes, and how often the forecast is right.
#include "app/stability_map.h"

#include <nlohmann/json.hpp>

#include <fstream>

#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

// Six tetrahedra that turn slowly, without gravity: soft enough to be stepped in one second, stiff enough to blow up.
const std::string kDie = R"(gravity = [0, 0, 0]
[time]
fps = 5
duration = 8
integrator = "symplectic-euler"
[[soft]]
name = "die"
block = { size = [0.2, 0.2, 0.2], cells = [1, 1, 1] }
material = { young = 1e5, poisson = 0.3 }
spin = [0, 20, 10]
)";

nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

}  // namespace

TEST_CASE("The forecast is right in 99 % of 400 measured cells, those within 5 % of the limit left out") {
  test::TempFolder folder;
  app::MapRequest request;
  request.scene = folder.write("scene.toml", kDie).string();
  request.x = app::parse_axis("--x", "soft.die.material.young=1e3..1e7", 20);
  request.y = app::parse_axis("--y", "time.substeps=6..200", 20);
  request.seconds = 500;
  REQUIRE(request.x.values.size() * request.y.values.size() == 400);
  app::SharedShapes shapes{std::filesystem::path()};
  const app::StabilityMap map = app::measure_map(request, shapes, [] {});
  const app::MapScore score = app::score_of(map);
  int held = 0, failed = 0;
  for (const app::MapCell& cell : map.cells) (cell.held() ? held : failed) += 1;
  MESSAGE(score.right << " of " << score.judged << " right, " << held << " held");
  CHECK(score.judged >= 370);  // a twentieth of the cells lies as near as that
  CHECK(score.right >= 0.99 * score.judged);
  CHECK(held >= 80);  // both sides are there
  CHECK(failed >= 80);
}

TEST_CASE("study --stability writes the map as CSV, JSON and pictures") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", kDie).string();
  const test::RunResult result = test::run({"study", scene, "--stability", "-o", (folder / "out").string(), "--x",
                                            "time.integrator=symplectic-euler,implicit-euler,forward-euler", "--y",
                                            "time.substeps=2..40", "--cells", "3x3", "-q"});
  INFO(result.err);
  REQUIRE(result.code == 0);
  CHECK(test::contains(result.out, "forecast right in"));
  const nlohmann::json map = read_json(folder / "out" / "stability.json");
  REQUIRE(map.at("cells").size() == 9);
  CHECK(map.at("y").at("values") == nlohmann::json({"2", "9", "40"}));
  const auto outcome = [&](size_t column, size_t row) {
    return map.at("cells").at(3 * row + column).at("outcome").get<std::string>();
  };
  CHECK(outcome(0, 0) == "blew up");
  CHECK(outcome(1, 0) != "blew up");
  CHECK(outcome(2, 0) == "blew up");
  CHECK(map.at("cells").at(1).at("step_over_limit") == 0);
  std::ifstream csv(folder / "out" / "stability.csv");
  std::string line;
  std::getline(csv, line);
  CHECK(line == "time.integrator,time.substeps,outcome,energy_change,step_over_limit,why");
  CHECK(std::filesystem::exists(folder / "out" / "stability.svg"));
  CHECK(std::filesystem::exists(folder / "out" / "stability.png"));
  test::check_only_whole_files(folder.path());
}

TEST_CASE("A map of what does not exist is refused, a cell that the scene cannot have is one outcome of many") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", kDie).string(), out = (folder / "out").string();
  const auto refused = [&](const char* what, const std::string& x, const std::string& y, const std::string& names) {
    test::check_refused({what, {"study", scene, "--stability", "-o", out, "--x", x, "--y", y, "-q"}, 2, {names}});
  };
  refused("unknown key", "soft.die.material.yong=1..2", "time.substeps=1,2", "young");
  refused("no range", "time.substeps", "time.substeps=1,2", "--x");
  refused("a range of names", "time.substeps=a..b", "time.substeps=1,2", "--x");
  refused("an empty value", "time.substeps=1,,2", "time.substeps=1,2", "--x");
  test::check_refused({"no axes", {"study", scene, "--stability", "-o", out}, 2, {"--x"}});
  test::check_refused({"cells",
                       {"study", scene, "--stability", "--x", "time.fps=1..2", "--y", "time.fps=1..2", "--cells", "9"},
                       2,
                       {"--cells"}});
  const test::RunResult some = test::run({"study", scene, "--stability", "-o", out, "--x",
                                          "soft.die.material.poisson=0.3,0.7", "--y", "time.substeps=200,300", "-q"});
  CHECK(some.code == 0);
  CHECK(test::contains(some.out, "refused"));
}

TEST_CASE("The range of an axis is in equal ratios, whole where it is written so, and each value once") {
  CHECK(app::parse_axis("--x", "a=1..100", 3).values == std::vector<std::string>{"1", "10", "100"});
  CHECK(app::parse_axis("--x", "a=1..3", 20).values == std::vector<std::string>{"1", "2", "3"});
  CHECK(app::parse_axis("--x", "a=1.0..4", 3).values == std::vector<std::string>{"1", "2", "4"});
  CHECK(app::parse_axis("--x", "a=-1..1", 3).values == std::vector<std::string>{"-1", "0", "1"});
  CHECK(app::parse_axis("--x", "a=b,c", 9).values == std::vector<std::string>{"b", "c"});
  CHECK_FALSE(app::parse_axis("--x", "a=b,c", 9).numeric);
}

TEST_CASE("study --regions draws the stability regions of all integrators") {
  test::TempFolder folder;
  const test::RunResult result = test::run({"study", "--regions", "-o", (folder / "out").string()});
  INFO(result.err);
  CHECK(result.code == 0);
  CHECK(std::filesystem::file_size(folder / "out" / "regions.svg") > 10000);
}

TEST_CASE("An interrupted or too short map keeps its cells, and the next call goes on from them") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", kDie).string(), out = (folder / "out").string();
  const auto map = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"study",
                                          scene,
                                          "--stability",
                                          "-o",
                                          out,
                                          "--x",
                                          "time.substeps=20..40",
                                          "--y",
                                          "soft.die.material.young=1e3,1e4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run(arguments);
  };
  const std::filesystem::path cells = folder / "out" / "cache" / "cells";
  const auto kept = [&] {
    return std::distance(std::filesystem::directory_iterator(cells), std::filesystem::directory_iterator());
  };
  REQUIRE(map({"--cells", "2x2"}).code == 0);
  const nlohmann::json first = read_json(folder / "out" / "stability.json");
  CHECK(kept() == 4);
  const test::RunResult more = map({"--cells", "3x2"});  // 20, 30, 40: two columns are known
  CHECK(more.code == 0);
  CHECK(test::contains(more.err, "4 cells were measured before"));
  CHECK(kept() == 6);
  const nlohmann::json second = read_json(folder / "out" / "stability.json");
  CHECK(second.at("cells").at(0) == first.at("cells").at(0));
  CHECK(second.at("cells").at(5) == first.at("cells").at(3));
  // A damaged one is measured again, another scene knows none.
  for (const auto& entry : std::filesystem::directory_iterator(cells)) std::ofstream(entry.path()) << "{\"outcome\": 3";
  const test::RunResult damaged = map({"--cells", "2x2"});
  CHECK(damaged.code == 0);
  CHECK_FALSE(test::contains(damaged.err, "measured before"));
  CHECK(read_json(folder / "out" / "stability.json").at("cells") == first.at("cells"));
  CHECK_FALSE(test::contains(map({"--cells", "2x2", "--set", "soft.die.density=900"}).err, "measured before"));
}
