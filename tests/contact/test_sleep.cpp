// Bodies at rest fall asleep, cost next to nothing, and wake when something touches them.
#include "scenes.h"

using namespace softreel;
using namespace softreel::sim;
using tests::moved;
using tests::TouchingScene;

namespace {

constexpr double kStep = 1.0 / 60, kSpeed = 5e-4;  // [s], [m/s]
constexpr int kTwoSeconds = 120;
const SolidMaterial kSoft{"stable-neo-hookean", 5e4, 0.4, 500};

Collider rough_ground() {
  Collider ground;
  ground.friction = 0.5;
  return ground;
}

/// Boxes of 0.2 m a hand above the ground, `apart` from each other; on the first lies a second one.
TouchingScene boxes(double speed, int count = 3, double apart = 0.5) {
  TouchingScene scene;
  scene.settings.sleep_speed = speed;
  scene.colliders = {rough_ground()};
  for (int i = 0; i < count; ++i)
    scene.add_solid("box" + std::to_string(i),
                    moved(block_of_tets(Vec3::Constant(0.2), 2, 2, 2), Vec3(apart * i, 0.11, 0)), kSoft, 0.5);
  scene.add_solid("lid", moved(block_of_tets(Vec3::Constant(0.16), 2, 2, 2), Vec3(0, 0.3, 0)), kSoft, 0.5);
  return scene;
}

Eigen::VectorXd positions_of(const Simulation& s, int body) {
  const BodyRange& range = s.model().bodies[static_cast<size_t>(body)];
  return s.state().x.segment(3 * range.first, 3 * range.count);
}

}  // namespace

TEST_CASE("bodies at rest fall asleep where they would have stayed, and steps without an awake body do nothing") {
  Simulation watched = boxes(kSpeed).start(), awake = boxes(0).start();
  CHECK_FALSE(awake.sleeps());
  int step = 0;
  double before = 0;
  for (; step < 4 * kTwoSeconds && watched.asleep() < 4; ++step) {
    before = watched.energies().contact;
    REQUIRE(watched.step(kStep).converged);
    REQUIRE(awake.step(kStep).converged);
  }
  REQUIRE(watched.asleep() == 4);
  CHECK(watched.state().t > 0.5);
  CHECK(watched.state().v.isZero(0));
  // Contact that is not evaluated any more is still there.
  CHECK(watched.energies().contact == doctest::Approx(before).epsilon(1e-3));
  const Eigen::VectorXd x = watched.state().x;
  const int more = 60;
  for (int i = 0; i < more; ++i) {
    const StepReport r = watched.step(kStep);
    REQUIRE(r.converged);
    CHECK(r.newton_iterations == 0);
    CHECK(r.hessians == 0);
    CHECK(r.contact_evaluations == 0);
    REQUIRE(awake.step(kStep).converged);
  }
  CHECK(watched.state().x == x);
  CHECK(watched.state().t == doctest::Approx((step + more) * kStep));
  // What is given up: no more than the speed allows in the time since the first of them fell asleep.
  CHECK((awake.state().x - x).cwiseAbs().maxCoeff() < kSpeed * (step + more) * kStep);
}

TEST_CASE("what sleeps is neither evaluated nor moved while others move") {
  TouchingScene scene = boxes(kSpeed);
  scene.builder.set_velocity(
      scene.add_solid("flyer", moved(block_of_tets(Vec3::Constant(0.2), 2, 2, 2), Vec3(0, 2, 0)), kSoft, 0.5),
      Vec3(0, 15, 0), Vec3(40, 50, 60));
  TouchingScene alone;
  alone.colliders = {rough_ground()};
  scene.settings.minimizer.tolerance = alone.settings.minimizer.tolerance = 1e-10;
  alone.builder.set_velocity(
      alone.add_solid("flyer", moved(block_of_tets(Vec3::Constant(0.2), 2, 2, 2), Vec3(0, 2, 0)), kSoft, 0.5),
      Vec3(0, 15, 0), Vec3(40, 50, 60));
  Simulation s = scene.start(), single = alone.start();
  tests::run_without_crossing(s, kStep, kTwoSeconds);
  for (int i = 0; i < kTwoSeconds; ++i) REQUIRE(single.step(kStep).converged);
  REQUIRE(s.asleep() == 4);
  const Eigen::VectorXd lid = positions_of(s, 3);
  for (int i = 0; i < 20; ++i) {
    const StepReport all = s.step(kStep), one = single.step(kStep);
    REQUIRE(all.converged);
    // As many terms for each matrix as of a scene that has the flyer alone.
    REQUIRE(all.newton_iterations > 0);
    CHECK(all.hessians * one.newton_iterations == one.hessians * all.newton_iterations);
  }
  CHECK(positions_of(s, 3) == lid);
  CHECK((positions_of(s, 4) - positions_of(single, 0)).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("a blow wakes the whole pile and loses no momentum") {
  const auto hit = [](double speed) {
    TouchingScene scene = boxes(speed, 1);
    scene.builder.set_velocity(scene.add_solid("ball", moved(tests::ball_of_tets(0.08, 3), Vec3(0, 6, 0)), kSoft, 0.5),
                               Vec3(0, 8, 0), Vec3::Zero());  // it comes back after two seconds
    return scene.start();
  };
  Simulation s = hit(kSpeed), awake = hit(0);
  bool slept = false, woken = false;
  for (int i = 0; i < 150 && !woken; ++i) {
    const bool asleep = s.asleep() > 0;
    tests::run_without_crossing(s, kStep, 1);
    REQUIRE(awake.step(kStep).converged);
    slept = slept || s.asleep() == 2;
    woken = asleep && s.asleep() == 0;
  }
  REQUIRE(slept);
  REQUIRE(woken);
  // The step of the blow is that of bodies which were never asleep, up to how far the pile had still to settle.
  const auto momentum = [](const Simulation& sim) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < sim.model().vertices(); ++i) sum += sim.model().masses(i) * sim.state().v.segment<3>(3 * i);
    return sum;
  };
  CHECK((momentum(s) - momentum(awake)).norm() < 1e-2 * momentum(awake).norm());
}

TEST_CASE("colliders that come to move wake what they touch, by a box or by a mesh") {
  const Motion lift({{0, {0, 0, 0}, {0, 0, 0}}, {3, {0, 0, 0}, {0, 0, 0}}, {4, {0, 0.5, 0}, {0, 0, 0}}}, {0, 0, 0});
  TouchingScene scene = boxes(kSpeed, 2);
  Collider table;
  table.shape = BoxShape{Vec3(0.2, 0.05, 0.2)};
  table.world_from_shape = Eigen::Translation3d(0.5, -0.06, 0);
  table.friction = 0.5;
  table.motion = lift;
  scene.colliders.push_back(table);
  Simulation s = scene.start();
  tests::run_without_crossing(s, kStep, 3 * kTwoSeconds / 2);
  REQUIRE(s.asleep() == 3);
  tests::run_without_crossing(s, kStep, 30);
  CHECK(s.asleep() == 2);  // the box on the table is awake, the pile beside it is not
  CHECK(positions_of(s, 1).reshaped(3, 27).row(1).minCoeff() > 0.1);
  // On a mesh with a motion nothing falls asleep.
  TouchingScene on_mesh;
  on_mesh.settings.sleep_speed = kSpeed;
  on_mesh.add_solid("box", moved(block_of_tets(Vec3::Constant(0.2), 2, 2, 2), Vec3(0, 0.11, 0)), kSoft, 0.5);
  on_mesh.add_mesh_collider("table", grid_sheet(1, 1, 2, 2), 0.5, lift);
  Simulation carried = on_mesh.start();
  tests::run_without_crossing(carried, kStep, 3 * kTwoSeconds / 2 + 30);
  CHECK(carried.asleep() == 0);
  CHECK(carried.state().x.reshaped(3, 27).row(1).minCoeff() > 0.1);
}

TEST_CASE("what sleeps falls when the collider under it leaves, however fast it is gone") {
  const Vec3 ways[] = {{0, -0.3, 0}, {3, 0, 0}};
  for (const Vec3& way : ways) {
    CAPTURE(way.transpose());
    TouchingScene scene = boxes(kSpeed, 1);
    scene.colliders.clear();
    Collider table;
    table.shape = BoxShape{Vec3(0.3, 0.05, 0.3)};
    table.world_from_shape = Eigen::Translation3d(0, -0.05, 0);
    table.friction = 0.5;
    table.motion =
        Motion({{0, {0, 0, 0}, {0, 0, 0}}, {3, {0, 0, 0}, {0, 0, 0}}, {3 + kStep, way, {0, 0, 0}}}, {0, 0, 0});
    scene.colliders.push_back(table);
    Simulation s = scene.start();
    tests::run_without_crossing(s, kStep, 3 * kTwoSeconds / 2);
    REQUIRE(s.asleep() == 2);
    const double height = positions_of(s, 0).reshaped(3, 27).row(1).minCoeff();
    tests::run_without_crossing(s, kStep, 12);
    CHECK(s.asleep() == 0);
    CHECK(height - positions_of(s, 0).reshaped(3, 27).row(1).minCoeff() > 0.1);  // of free fall in 0.2 s: 0.2 m
  }
}

TEST_CASE("a mesh collider that comes when all are asleep wakes what it hits") {
  TouchingScene scene = boxes(kSpeed, 1);
  const Motion press({{0, {0, 0, 0}, {0, 0, 0}}, {3, {0, 0, 0}, {0, 0, 0}}, {3.5, {0, -0.25, 0}, {0, 0, 0}}},
                     {0, 0, 0});
  scene.add_mesh_collider("press", tests::moved(grid_sheet(1, 1, 2, 2), Vec3(0, 0.55, 0)), 0.5, press);
  Simulation s = scene.start();
  tests::run_without_crossing(s, kStep, 3 * kTwoSeconds / 2);
  REQUIRE(s.asleep() == 2);
  tests::run_without_crossing(s, kStep, 30);
  CHECK(s.asleep() == 0);
  CHECK(positions_of(s, 1).reshaped(3, 27).row(1).maxCoeff() < 0.3);
}

TEST_CASE("what lies on a body that is pinned everywhere falls asleep") {
  TouchingScene scene = boxes(kSpeed, 1);
  const BodyRange shelf =
      scene.add_solid("shelf", moved(block_of_tets(Vec3::Constant(0.4), 1, 1, 1), Vec3(0, -0.2, 0)), kSoft, 0.5);
  Pin pin;
  for (int v = shelf.first; v < shelf.first + shelf.count; ++v) pin.vertices.push_back(v);
  scene.builder.add_pin(pin);
  scene.colliders.clear();
  Simulation s = scene.start();
  tests::run_without_crossing(s, kStep, 3 * kTwoSeconds / 2);
  CHECK(s.asleep() == 3);
}

TEST_CASE("a state from before anything slept can be taken up again by a run that sleeps") {
  Simulation s = boxes(kSpeed, 1).start();
  for (int i = 0; i < 10; ++i) REQUIRE(s.step(kStep).converged);
  const State state = s.state();
  const std::vector<double> memory = s.memory();
  for (int i = 0; i < 3 * kTwoSeconds / 2; ++i) REQUIRE(s.step(kStep).converged);
  const Eigen::VectorXd end = s.state().x;
  REQUIRE(s.asleep() == 2);
  s.restore(state, memory);
  CHECK(s.asleep() == 0);
  for (int i = 0; i < 3 * kTwoSeconds / 2; ++i) REQUIRE(s.step(kStep).converged);
  CHECK(s.state().x == end);
}

TEST_CASE("what has not moved yet, what is driven and what a changing load acts on stays awake") {
  TouchingScene scene;
  scene.settings.sleep_speed = kSpeed;
  scene.gravity = Vec3::Zero();
  const auto add = [&](const char* name, double x) {
    return scene.add_solid(name, moved(block_of_tets(Vec3::Constant(0.2), 1, 1, 1), Vec3(x, 0.2, 0)), kSoft, 0.5);
  };
  add("never moved", 0);
  const BodyRange driven = add("driven", 1), loaded = add("loaded", 2), free = add("free", 3);
  Pin pin;
  pin.vertices = {driven.first, driven.first + 1, driven.first + 2};
  pin.motion = Motion({{0, {0, 0, 0}, {0, 0, 0}}, {9, {0, 1e-4, 0}, {0, 0, 0}}}, {0, 0, 0});
  scene.builder.add_pin(pin);
  scene.builder.add_load({{loaded.first}, {Vec3(0, 1e-9, 0)}}, {3, 4, 0});
  for (const BodyRange& body : {driven, loaded, free}) scene.builder.set_velocity(body, Vec3::Zero(), Vec3(0, 9, 0));
  scene.builder.set_surfaces(scene.surfaces, scene.rules);
  Simulation s(scene.builder.finish(scene.gravity, {50, 0, 0}, {}, scene.contact), scene.settings);
  for (int i = 0; i < kTwoSeconds; ++i) REQUIRE(s.step(kStep).converged);
  CHECK(s.asleep() == 1);
  const BodyRange& range = s.model().bodies[3];
  CHECK(range.name == "free");
  CHECK(s.state().v.segment(3 * range.first, 3 * range.count).isZero(0));
}

TEST_CASE("a run goes on from what was saved, asleep or not, with the same bits") {
  for (const std::string integrator : {"implicit-euler", "bdf2"}) {
    CAPTURE(integrator);
    const auto start = [&] {
      TouchingScene scene = boxes(kSpeed, 2);
      scene.settings.integrator = integrator;
      scene.damping.beta = 5e-3;
      scene.builder.set_velocity(
          scene.add_solid("ball", moved(tests::ball_of_tets(0.08, 3), Vec3(0.5, 6, 0)), kSoft, 0.5), Vec3(0, 15, 0),
          Vec3::Zero());  // it comes back after three seconds
      return scene.start();
    };
    Simulation whole = start();
    for (int i = 0; i < 3 * kTwoSeconds / 2 && whole.asleep() == 0; ++i) REQUIRE(whole.step(kStep).converged);
    REQUIRE(whole.asleep() > 0);
    const State state = whole.state();
    const std::vector<double> memory = whole.memory();
    Simulation resumed = start();
    resumed.restore(state, memory);
    CHECK(resumed.asleep() == whole.asleep());
    bool woken = false;
    for (int i = 0; i < 2 * kTwoSeconds; ++i) {
      const int asleep = whole.asleep();
      REQUIRE(whole.step(kStep).converged);
      REQUIRE(resumed.step(kStep).converged);
      woken = woken || whole.asleep() < asleep;
    }
    CHECK(woken);
    CHECK(whole.state().x == resumed.state().x);
    CHECK(whole.state().v == resumed.state().v);
    CHECK(whole.memory() == resumed.memory());
  }
}

TEST_CASE("bodies sleep and wake with explicit methods as well") {
  for (const std::string integrator : {"symplectic-euler", "verlet", "rk4"}) {
    CAPTURE(integrator);
    TouchingScene scene;
    scene.settings.integrator = integrator;
    scene.settings.sleep_speed = kSpeed;
    scene.contact.hardness = kExplicitHardness;
    scene.contact.material = 0;
    scene.damping.alpha = 30;
    scene.colliders = {Collider()};  // explicit friction trembles
    scene.add_solid("box", moved(block_of_tets(Vec3::Constant(0.2), 2, 2, 2), Vec3(0, 0.105, 0)), kSoft, 0.5);
    scene.add_solid("ball", moved(tests::ball_of_tets(0.08, 2), Vec3(0, 1, 0)), kSoft, 0.5);
    Simulation s = scene.start();
    const double h = 1e-3;
    int i = 0;
    for (; i < 2000 && s.asleep() == 0; ++i) {
      const StepReport r = s.step(h);
      REQUIRE_MESSAGE(r.converged, i, r.reason);
    }
    REQUIRE(s.asleep() == 1);
    const Eigen::VectorXd box = positions_of(s, 0);
    for (int k = 0; k < 50; ++k) REQUIRE(s.step(h).converged);
    CHECK(s.asleep() == 1);
    CHECK(positions_of(s, 0) == box);
    for (; i < 4000 && s.asleep() == 1; ++i) REQUIRE(s.step(h).converged);
    CHECK(s.asleep() == 0);
    CHECK(tests::crossing_count(s) == 0);
  }
}
