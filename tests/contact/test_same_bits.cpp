#include "scenes.h"
#include "sim/parallel.h"

using namespace softreel;
using namespace softreel::sim;
using tests::moved;
using tests::TouchingScene;

namespace {

/// A cloth with itself, on a soft block on a mesh that moves: all kinds of pairs, friction, something driven.
Simulation busy_scene() {
  TouchingScene scene;
  scene.add_cloth("cloth", moved(grid_sheet(0.6, 0.6, 16, 16), Vec3(0, 0.27, 0), Vec3(3, 0, 5)),
                  {"stvk", 1e4, 0.3, 1e-3, 1e-6, BendingModel::kAuto, 0.2}, 0.3, true);
  scene.add_solid("block", moved(block_of_tets(Vec3(0.2, 0.2, 0.2), 3, 3, 3), Vec3(0, 0.12, 0)),
                  {"stable-neo-hookean", 3e4, 0.4, 1000}, 0.4);
  scene.add_mesh_collider("table", grid_sheet(1, 1, 3, 3), 0.4,
                          Motion({{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.1, 0.1, 0}, {0, 40, 0}}}, {0, 0, 0}));
  return scene.start();
}

constexpr double kStep = 1.0 / 60;

}  // namespace

TEST_CASE("contact between surfaces gives the same bits with any number of threads") {
  const int before = threads();
  std::vector<Eigen::VectorXd> ends;
  for (const int count : {1, 2, 3}) {
    set_threads(count);
    Simulation s = busy_scene();
    tests::run_without_crossing(s, kStep, 24);
    CHECK(s.model().surfaces->report(s.state().x).active > 20);
    ends.push_back(s.state().x);
  }
  set_threads(before);
  CHECK(ends[0] == ends[1]);
  CHECK(ends[0] == ends[2]);
}

TEST_CASE("a run with contact goes on from what was saved with the same bits") {
  Simulation whole = busy_scene();
  tests::run_without_crossing(whole, kStep, 16);
  const State state = whole.state();
  const std::vector<double> memory = whole.memory();
  Simulation resumed = busy_scene();
  resumed.restore(state, memory);
  tests::run_without_crossing(whole, kStep, 8);
  tests::run_without_crossing(resumed, kStep, 8);
  CHECK(whole.state().x == resumed.state().x);
  CHECK(whole.state().v == resumed.state().v);
  CHECK(whole.memory() == resumed.memory());
}

TEST_CASE("a scene without surfaces has no contact stage, and one whose bodies stay apart looks at no pair") {
  ModelBuilder builder;
  builder.add_solid("alone", block_of_tets(Vec3(1, 1, 1), 1, 1, 1), {"stable-neo-hookean", 1e5, 0.3, 1000});
  CHECK(builder.finish(tests::kGravity, {}, {}, {}).surfaces == nullptr);
  TouchingScene scene;
  scene.gravity = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    scene.add_solid("block " + std::to_string(i), moved(block_of_tets(Vec3(1, 1, 1), 2, 2, 2), Vec3(5 * i, 0, 0)),
                    {"stable-neo-hookean", 1e5, 0.3, 1000}, 0.3);
  Simulation s = scene.start();
  tests::run_without_crossing(s, kStep, 2);
  CHECK(s.model().surfaces->report(s.state().x).candidates == 0);
}
