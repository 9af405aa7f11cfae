// A run that goes wrong stops early, names the body and the cause, and keeps what was good.
#include "app/run_watch.h"

#include <regex>

#include "assets/scene_reader.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

// Steps of 1.03 times the limit: the fastest mode grows by a factor of 1.6 a step, from what the spin puts into it.
const std::string kSlowlyUnstable = R"(gravity = [0, 0, 0]
[time]
fps = 50
duration = 4
substeps = 1
integrator = "symplectic-euler"
[[soft]]
name = "die"
block = { size = [0.2, 0.2, 0.2], cells = [1, 1, 1] }
material = { young = 13100, poisson = 0.3 }
spin = [0, 20, 10]
)";

}  // namespace

TEST_CASE(
    "A run that blows up slowly ends with the energy, the body, the cause and the setting, and keeps its frames") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", kSlowlyUnstable).string();
  const auto simulate = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"simulate", scene, "-o", (folder / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run(arguments);
  };
  const test::RunResult result =
      simulate({"--force", "--set", "time.substeps=1", "--set", "soft.die.material.young=1e6"});
  INFO(result.err);
  CHECK(result.code == 4);
  CHECK(std::regex_search(result.err, std::regex("(came from nowhere|ran away)")));
  CHECK(test::contains(result.err, "'die' moved fastest"));
  CHECK(test::contains(result.err, "is unstable: h omega"));
  CHECK(test::contains(result.err, "time.substeps = "));
  std::smatch kept;
  REQUIRE(std::regex_search(result.err, kept, std::regex("Frames 1 to ([0-9]+) are kept")));
  CHECK(static_cast<int>(test::states_in(folder / "out").size()) == std::stoi(kept[1]));
}

TEST_CASE("The energy watch stops what gains energy from nowhere, and nothing that holds") {
  test::TempFolder folder;
  const assets::Scene scene = assets::read_scene(folder.write("scene.toml", kSlowlyUnstable).string(), {});
  const app::Shapes shapes = app::load_shapes(scene, {});
  app::RunWatch watch(scene, shapes);
  app::CachedFrame frame;
  frame.state.x = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(shapes.soft[0].rest.vertices.size()));
  frame.figures.energies.kinetic = 1;
  CHECK_FALSE(watch.look(frame));
  frame.figures.energies = {5, 10, -14, 0, 0};  // fell: what gravity gave is no gain
  CHECK_FALSE(watch.look(frame));
  frame.figures.energies = {100, 100, -14, 0, 0};
  CHECK_FALSE(watch.look(frame));  // 12 times what was in motion before: a step near its limit may swing so far
  frame.figures.energies = {5000, 0, -14, 0, 0};
  const auto why = watch.look(frame);
  REQUIRE(why);
  CHECK(test::contains(*why, "came from nowhere"));
  assets::Scene implicit = scene;
  implicit.time.integrator = "implicit-euler";
  app::RunWatch other(implicit, shapes);
  frame.figures.energies = {1, 0, 0, 0, 0};
  CHECK_FALSE(other.look(frame));
  frame.figures.energies = {5000, 0, 0, 0, 0};
  CHECK_FALSE(other.look(frame));  // its solver looks after itself
}

TEST_CASE("Tetrahedra that are inside out are counted, body by body and in the stats of each frame") {
  test::TempFolder folder;
  const std::string file = folder.write("scene.toml", kSlowlyUnstable).string();
  const assets::Scene scene = assets::read_scene(file, {});
  const app::Shapes shapes = app::load_shapes(scene, {});
  const auto& rest = shapes.soft[0].rest;
  Eigen::VectorXd x(3 * static_cast<Eigen::Index>(rest.vertices.size()));
  for (size_t i = 0; i < rest.vertices.size(); ++i) x.segment<3>(3 * static_cast<Eigen::Index>(i)) = rest.vertices[i];
  CHECK(app::inverted_tets(shapes, x) == std::vector<int>{0});
  for (Eigen::Index i = 0; i < x.size(); i += 3) x(i) = -x(i);
  CHECK(app::inverted_tets(shapes, x) == std::vector<int>{static_cast<int>(rest.tets.size())});
  const auto stats = test::stats_of(
      {"simulate", file, "-o", (folder / "out").string(), "--set", "time.substeps=8", "--frames", "1-4"}, folder);
  for (const char* figure : {"steps", "newton_iterations", "retried_steps", "residual", "inverted_tets"})
    CHECK(stats.at("per_frame").at(figure).size() == 4);
  CHECK(stats.at("per_frame").at("steps").at(1) == 8);
  CHECK(stats.at("per_frame").at("inverted_tets").at(3) == 0);
}

TEST_CASE("The momentum watch sees momentum that no force has brought, and only where it is kept") {
  test::TempFolder folder;
  const std::string file = folder.write("scene.toml", kSlowlyUnstable).string();
  // Gravity, a throw and a spin: the momentum is that of the fall, for every method, up to how far steps are solved.
  const std::vector<std::string> thrown = {"gravity=[0,-9.81,0]", "soft.die.velocity=[1,2,3]", "time.duration=0.4"};
  for (const std::string method : {"symplectic-euler", "implicit-euler", "bdf2", "newmark", "verlet"}) {
    INFO(method);
    std::vector<std::string> arguments = {"simulate", file,
                                          "-o",       (folder / method).string(),
                                          "--set",    "time.substeps=8",
                                          "--set",    "time.integrator=\"" + method + "\""};
    for (const std::string& key : thrown) arguments.insert(arguments.end(), {"--set", key});
    const auto drift = test::stats_of(arguments, folder).at("per_frame").at("momentum_drift");
    REQUIRE(drift.size() == 20);
    for (const double d : drift) CHECK(d < 1e-3);  // solver.tolerance
  }
  const auto has_drift = [&](const std::string& more) {
    const auto stats = test::stats_of({"simulate", file, "-o", (folder / "other").string(), "--set", "time.substeps=8",
                                       "--frames", "1-2", "--set", more},
                                      folder);
    return stats.at("per_frame").contains("momentum_drift");
  };
  CHECK(has_drift("damping.beta=1e-5"));  // takes energy, not momentum
  CHECK_FALSE(has_drift("damping.drag=0.1"));
  CHECK_FALSE(has_drift("soft.die.pins=[{vertices=[0]}]"));
  const assets::Scene scene = assets::read_scene(file, {});
  const app::Shapes shapes = app::load_shapes(scene, {});
  app::RunWatch watch(scene, shapes);
  app::CachedFrame frame;
  frame.state.x = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(shapes.soft[0].rest.vertices.size()));
  frame.figures.energies.kinetic = 1;
  frame.figures.momentum_drift = 0.09;
  CHECK_FALSE(watch.look(frame));
  frame.figures.momentum_drift = 0.12;
  const auto why = watch.look(frame);
  REQUIRE(why);
  CHECK(test::contains(*why, "momentum is off by 12 %"));
}

TEST_CASE("Steps that are hardly solved lose momentum, and the run says so with the setting to change") {
  test::TempFolder folder;
  const std::string file = folder.write("scene.toml", kSlowlyUnstable).string();
  const test::RunResult result =
      test::run({"simulate", file, "-o", (folder / "out").string(), "--set", "time.integrator=\"implicit-euler\"",
                 "--set", "gravity=[0,-9.81,0]", "--set", "solver.method=\"gradient-descent\"", "--set",
                 "solver.tolerance=0.9", "--set", "soft.die.material.young=1e7"});
  INFO(result.err);
  CHECK(result.code == 4);
  CHECK(test::contains(result.err, "momentum is off by"));
  CHECK(test::contains(result.err, "solver.tolerance = 0.9"));
}
