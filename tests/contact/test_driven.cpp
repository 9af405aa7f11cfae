// Pins and mesh colliders that are driven into bodies: nothing crosses on the way.
#include "scenes.h"

using namespace softreel;
using namespace softreel::sim;
using tests::moved;
using tests::TouchingScene;

namespace {

constexpr double kStep = 1.0 / 60;  // [s]
const SolidMaterial kSoft{"stable-neo-hookean", 5e4, 0.4, 500};
const Motion kPress({{0, {0, 0, 0}, {0, 0, 0}}, {0.2, {0, -0.15, 0}, {0, 0, 0}}}, {0, 0, 0});  // from y = 0.28 [m]

/// A soft box on an analytic ground.
TouchingScene box_on_ground() {
  TouchingScene scene;
  scene.colliders = {Collider()};
  scene.add_solid("box", moved(block_of_tets(Vec3::Constant(0.2), 2, 2, 2), Vec3(0, 0.102, 0)), kSoft, 0.5);
  return scene;
}

void check_pressed(Simulation& s) {
  tests::run_without_crossing(s, kStep, 15);
  CHECK(s.state().x.head(3 * 27).reshaped(3, 27).row(1).maxCoeff() < 0.13);
}

}  // namespace

TEST_CASE("a mesh collider presses a body onto an analytic one without crossing it") {
  TouchingScene scene = box_on_ground();
  scene.add_mesh_collider("press", moved(grid_sheet(1, 1, 4, 4), Vec3(0, 0.28, 0)), 0.5, kPress);
  Simulation s = scene.start();
  check_pressed(s);
}

TEST_CASE("pins press a body onto an analytic collider without crossing it") {
  TouchingScene scene = box_on_ground();
  const BodyRange press =
      scene.add_solid("press", moved(block_of_tets(Vec3(0.4, 0.1, 0.4), 2, 1, 2), Vec3(0, 0.33, 0)), kSoft, 0.5);
  Pin pin;
  for (int v = press.first; v < press.first + press.count; ++v) pin.vertices.push_back(v);
  pin.motion = kPress;
  scene.builder.add_pin(pin);
  Simulation s = scene.start();
  check_pressed(s);
}
