// Pieces of softreel study, in process.
#include <cmath>

#include "app/study_apply.h"
#include "app/study_measures.h"
#include "app/study_reference.h"
#include "app/study_summary.h"
#include "assets/error.h"
#include "assets/scene_canonical.h"
#include "assets/scene_reader.h"
#include "tests/app/clip.h"

using namespace softreel;
using namespace softreel::app;

namespace {

assets::Scene parsed(const std::string& text, std::vector<std::string> overrides = {}) {
  return assets::parse_scene(text, "scene.toml", overrides);
}

StudyRow synthetic(double step, double error, double wall) {
  StudyRow row;
  row.method = std::string("m");
  row.step = step;
  row.wall = wall;
  row.run = true;
  row.errors = PositionErrors{error, error, error, error, 10 * error, 10 * error};
  return row;
}

}  // namespace

TEST_CASE("the observed order is the slope between the coarse and the floor") {
  std::vector<StudyRow> rows;
  for (const double h : {0.4, 0.2, 0.1, 0.05, 0.025, 0.0125}) rows.push_back(synthetic(h, 3 * std::pow(h, 2), 1 / h));
  rows[0].errors->worst = 0.5;   // too coarse to tell anything
  rows[5].errors->worst = 4e-3;  // stuck at the floor
  REQUIRE(observed_order(rows, "m", 4e-4, 1));
  CHECK(*observed_order(rows, "m", 4e-4, 1) == doctest::Approx(2));
  CHECK_FALSE(observed_order(rows, "other", 0, 1));
  CHECK_FALSE(observed_order(rows, "m", 1, 1));  // all below the floor
}

TEST_CASE("the fastest run within a target is the one with the least wall time that meets it") {
  const std::vector<StudyRow> rows = {synthetic(1, 0.5, 1), synthetic(0.5, 0.03, 2), synthetic(0.25, 0.001, 9),
                                      synthetic(0.2, 0.009, 5)};
  CHECK(fastest(rows, parse_target("1%"), 1) == &rows[3]);
  CHECK(fastest(rows, parse_target("1%"), 10) == &rows[1]);
  CHECK(fastest(rows, parse_target("0.05px"), 1) == &rows[2]);
  CHECK(fastest(rows, parse_target("1 mm"), 1) == &rows[2]);
  CHECK(fastest(rows, parse_target("0.5mm"), 1) == nullptr);
  for (const char* bad : {"", "1", "1 in", "-1%", "0mm", "nan px", "infm", "%"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(parse_target(bad), assets::UserError);
  }
}

TEST_CASE("values of a sweep are taken apart at commas outside brackets") {
  CHECK(split_values("a,[1, 2], c") == std::vector<std::string>{"a", "[1, 2]", "c"});
  CHECK(split_values("1") == std::vector<std::string>{"1"});
}

TEST_CASE("settings go into a scene's text where they are or where they belong, comments stay") {
  const std::string body = "[[cloth]]\nname = \"a\"\ngrid = { size = [1, 1], cells = [4, 4] } # few\n";
  const std::vector<std::pair<std::string, std::string>> settings = {{"gravity", "[0, -1, 0]"},
                                                                     {"time.substeps", "7"},
                                                                     {"time.integrator", "bdf2"},
                                                                     {"solver.tolerance", "1e-5"},
                                                                     {"cloth.1.grid.cells", "[2, 3]"}};
  const std::vector<std::pair<std::string, std::string>> around = {
      {"", ""},
      {"# été\n[time]\nsubsteps = 4 # äß\n", ""},
      {"time = { fps = 24, substeps = 3 }\n", ""},
      {"[time] # time\nintegrator = 'newmark' # says who\n[solver]\n", ""},
      {"", "[solver]\ntolerance = 1_0e-1\n"},
      {"solver = {}\n", ""}};
  for (const auto& [before, after] : around) {
    std::string text = before;
    text.append(body).append(after);
    CAPTURE(text);
    const std::string changed = with_settings(text, "scene.toml", settings);
    CHECK(test::contains(changed, "# few"));
    const assets::Scene scene = parsed(changed);
    CHECK(scene.gravity.y() == -1);
    CHECK(scene.time.substeps == 7);
    CHECK(scene.time.integrator == "bdf2");
    CHECK(scene.solver.tolerance == 1e-5);
    CHECK(scene.cloth[0].grid->cells == std::array<int, 2>{2, 3});
    CHECK(assets::canonical_physics(scene) ==
          assets::canonical_physics(parsed(text, {"gravity=[0, -1, 0]", "time.substeps=7", "time.integrator=bdf2",
                                                  "solver.tolerance=1e-5", "cloth.1.grid.cells=[2, 3]"})));
  }
}

TEST_CASE("material points are met on other meshes, affine motions exactly") {
  const std::string scene =
      "[[soft]]\nname = \"s\"\nblock = { size = [1, 0.5, 0.5], cells = [3, 2, 2] }\n"
      "[[cloth]]\nname = \"c\"\ngrid = { cells = [3, 5] }\ntranslate = [0, 2, 0]\n"
      "[[springs]]\nname = \"r\"\nchain = { links = 4 }\ntranslate = [0, 3, 0]\n";
  const assets::Scene coarse = parsed(scene);
  const assets::Scene fine = parsed(scene, resolution_overrides(coarse, 1.5));
  CHECK(fine.soft[0].block->cells == std::array<int, 3>{5, 3, 3});  // 4.5 is rounded
  SharedShapes shapes("");
  const StudyPoints points = study_points(coarse, shapes.of(coarse), "");
  const Eigen::Matrix3d A = (Eigen::Matrix3d() << 1, 0.2, 0, -0.3, 2, 0.1, 0, 0.5, 0.7).finished();
  const Eigen::Vector3d b(1, -2, 3);
  const auto moved = [&](const assets::Scene& s) {
    Eigen::VectorXd x = ClipWorld(s, shapes.of(s)).frame({}).state.x;
    for (Eigen::Index i = 0; i < x.size(); i += 3) x.segment<3>(i) = A * x.segment<3>(i) + b;
    return x;
  };
  const Eigen::Matrix3Xd own = PointMap(points, shapes.of(coarse)).at(moved(coarse));
  const Eigen::Matrix3Xd other = PointMap(points, shapes.of(fine)).at(moved(fine));
  REQUIRE(own.cols() == static_cast<Eigen::Index>(points.count()));
  CHECK((own - other).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("the error that a finer run claims for itself is the one that the closed form shows") {
  test::TempFolder folder;
  const std::string text = test::slurp(SOFTREEL_SOURCE_DIR "/assets/scenes/oscillator.toml");
  std::string open = text;
  open.erase(open.find("[reference]"), open.find("[camera]") - open.find("[reference]"));
  SweepRequest request;
  request.integrators = {"verlet"};
  request.substeps = {"1"};
  request.overrides = {"time.duration=0.5", "time.substeps=1"};
  const auto reference = [&](const std::string& scene_text, const char* name) {
    request.scene = folder.write(name, scene_text).string();
    const Sweep sweep = plan_sweep(request);
    SharedShapes shapes("");
    const StudyPoints points = study_points(sweep.scene, shapes.of(sweep.scene), "springs.1");
    return make_reference(request, sweep, points, shapes, folder / "cache", 60, true);
  };
  const StudyReference exact = reference(text, "exact.toml"), finer = reference(open, "open.toml");
  const double error = position_errors(finer.points, exact.points, nullptr).worst;
  MESSAGE(finer.what << ": claims " << finer.floor << " m, has " << error << " m");
  CHECK(finer.order == doctest::Approx(4).epsilon(0.05));
  CHECK(finer.floor > 0);
  CHECK(error < 2 * finer.floor);
  CHECK(finer.floor < 2 * error);
  const StudyReference again = reference(open, "open.toml");  // from the cache
  CHECK(again.floor == finer.floor);
  CHECK(again.what == finer.what);
  for (size_t f = 0; f < finer.points.size(); ++f) CHECK(again.points[f] == finer.points[f]);
}

TEST_CASE("what a free body keeps is found kept, what it has not is absent") {
  const assets::Scene scene = parsed(
      "[time]\nduration = 0.3\nsubsteps = 8\nintegrator = \"verlet\"\n"
      "[[soft]]\nname = \"s\"\nblock = { cells = [2, 1, 1] }\nspin = [0, 0, 90]\nmaterial = { young = 2e4 }\n");
  SharedShapes shapes("");
  const Trial trial = run_trial(scene, shapes.of(scene));
  REQUIRE_FALSE(trial.failure);
  const Drifts d = drifts(scene, shapes.of(scene), trial, 1);
  REQUIRE(d.momentum);
  REQUIRE(d.angular);
  REQUIRE(d.energy);
  REQUIRE(d.volume);
  CHECK(*d.momentum < 1e-12);
  CHECK(*d.angular < 1e-12);
  CHECK(*d.energy < 0.05);
  CHECK(*d.volume > 0);  // it stretches as it spins
  CHECK(*d.volume < 0.05);
  CHECK_FALSE(d.penetration);
  CHECK_FALSE(d.pins);
}

TEST_CASE("the deepest intrusion and the held vertices are measured against colliders and pins") {
  const assets::Scene scene = parsed(
      "[time]\nduration = 0.1\n[[springs]]\nname = \"p\"\npoints = [[0, 0.5, 0], [1, 0.5, 0]]\nedges = [[0, 1]]\n"
      "pins = [{ vertices = [0] }]\n[[collider]]\nshape = \"plane\"\n");
  SharedShapes shapes("");
  Trial trial = run_trial(scene, shapes.of(scene));
  REQUIRE_FALSE(trial.failure);
  CHECK(*drifts(scene, shapes.of(scene), trial, 1).penetration == 0);
  CHECK(*drifts(scene, shapes.of(scene), trial, 1).pins == 0);
  trial.frames[1].state.x(4) = -0.25;
  trial.frames[2].state.x(0) += 0.125;
  CHECK(*drifts(scene, shapes.of(scene), trial, 1).penetration == doctest::Approx(0.25));
  CHECK(*drifts(scene, shapes.of(scene), trial, 1).pins == doctest::Approx(0.125));
  CHECK_FALSE(drifts(scene, shapes.of(scene), trial, 1).momentum);
}
