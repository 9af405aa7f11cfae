// Analytic colliders: nothing comes out on their other side, however fast it is.
#include <random>

#include "scenes.h"
#include "sim/collider_contact.h"

using namespace softreel;
using namespace softreel::sim;
using tests::moved;
using tests::TouchingScene;

namespace {

constexpr double kStep = 1.0 / 60;  // [s]
const SolidMaterial kSoft{"stable-neo-hookean", 1e5, 0.4, 500};

struct Shape {
  const char* name;
  ColliderShape shape;
  double top;      // [m]
  double deepest;  // that a vertex may come [m]
};
// 20 contact distances of 2 mm, or 0.9 of the deepest point.
const Shape kBlock{"block", BoxShape{Vec3(1, 0.15, 1)}, 0.15, 0.04};
const Shape kPlate{"plate", BoxShape{Vec3(1, 0.005, 1)}, 0.005, 0.0045};
const Shape kFoil{"foil", BoxShape{Vec3(1, 0.001, 1)}, 0.001, 0.0009};
const Shape kSphere{"sphere", SphereShape{0.3}, 0.3, 0.04};
const Shape kCapsule{"capsule", CapsuleShape{0.05, 0.5}, 0.55, 0.04};

struct Throw {
  Shape shape;
  std::string integrator;
  double speed;  // [m/s], downwards
};

/// A soft cube that comes down on a collider, which it meets in the second step.
Simulation start(const Throw& t, const Motion& motion = {}) {
  TouchingScene scene;
  scene.settings.integrator = t.integrator;
  Collider wall;
  wall.shape = t.shape.shape;
  wall.motion = motion;
  const BodyRange body =
      scene.builder.add_solid("cube",
                              moved(block_of_tets(Vec3::Constant(0.2), 3, 3, 3),
                                    Vec3(0.01, t.shape.top + 0.15 + 1.3 * t.speed * kStep, 0.013), Vec3(10, 20, 5)),
                              kSoft);
  scene.builder.set_velocity(body, Vec3(0, -t.speed, 0), Vec3::Zero());
  return Simulation(scene.builder.finish(Vec3::Zero(), {}, {wall}, scene.contact), scene.settings);
}

/// The deepest point of all straight ways of vertices between two states, as the collider sees them; by sampling.
double deepest_on_the_way(const Simulation& s, const State& before) {
  constexpr int kSamples = 400;
  const Collider& wall = s.model().contact->colliders()[0];
  const Eigen::Isometry3d from = wall.pose(before.t).inverse(), to = wall.pose(s.state().t).inverse();
  double deepest = 0;
  for (int i = 0; i < s.model().vertices(); ++i) {
    const Vec3 a = from * before.x.segment<3>(3 * i), b = to * s.state().x.segment<3>(3 * i);
    for (int k = 0; k <= kSamples; ++k)
      deepest = std::max(deepest, -signed_distance(wall.shape, a + (b - a) * k / kSamples).distance);
  }
  return deepest;
}

/// Steps as long as they hold, and looks at each. Returns how many held.
int steps_that_hold(Simulation& s, const Throw& t, int most) {
  for (int i = 0; i < most; ++i) {
    const State before = s.state();
    const StepReport r = s.step(kStep);
    if (!r.converged) {
      CHECK_MESSAGE((r.reason.find("'cube'") != std::string::npos || r.reason.find("ran away") != std::string::npos),
                    r.reason);
      CHECK(s.state().x == before.x);
      return i;
    }
    if (r.retries == 0) CHECK(deepest_on_the_way(s, before) < t.shape.deepest);
  }
  return most;
}

}  // namespace

TEST_CASE("no vertex gets through a collider in a step that holds, whatever its speed and the integrator") {
  for (const Shape& shape : {kBlock, kPlate, kFoil, kSphere, kCapsule})
    for (const char* integrator : {"implicit-euler", "bdf2", "newmark", "implicit-midpoint", "verlet"})
      for (const double speed : {10.0, 100.0, 1000.0}) {
        CAPTURE(shape.name);
        CAPTURE(integrator);
        CAPTURE(speed);
        const Throw t{shape, integrator, speed};
        Simulation s = start(t);
        steps_that_hold(s, t, 4);
      }
}

TEST_CASE("a block stops 1000 m/s and a plate of a centimetre 10 m/s, in whole steps") {
  for (const std::string integrator : {"implicit-euler", "bdf2"})
    for (const auto& [shape, speed] : {std::pair(kBlock, 10.0), {kBlock, 100.0}, {kBlock, 1000.0}, {kPlate, 10.0}}) {
      CAPTURE(integrator);
      CAPTURE(shape.name);
      CAPTURE(speed);
      const Throw t{shape, integrator, speed};
      Simulation s = start(t);
      REQUIRE(steps_that_hold(s, t, 8) == 8);
      CHECK(s.state().x.reshaped(3, 64).row(1).minCoeff() > shape.top - shape.deepest);
    }
}

TEST_CASE("a plate that is swung at a body takes it along") {
  const Throw t{kPlate, "implicit-euler", 0};
  Simulation s = start(t, Motion({{0, {0, 0, 0}, {0, 0, 0}}, {1, {0, 2, 0}, {0, 0, 0}}}, {0, 0, 0}));  // 2 m/s
  REQUIRE(steps_that_hold(s, t, 20) == 20);
  CHECK(s.state().x.reshaped(3, 64).row(1).minCoeff() > 2 * 20 * kStep);
}

TEST_CASE("the share of a way that is free never reaches a core, and ends near it") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-0.7, 0.7);
  for (const Shape& shape : {kBlock, kPlate, kFoil, kSphere, kCapsule}) {
    CAPTURE(shape.name);
    const ColliderCore core = core_of(shape.shape, 2e-3).value();
    CHECK(core.depth == doctest::Approx(shape.deepest));
    int cut = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a(at(random), at(random), at(random)), b(at(random), at(random), at(random));
      const double share = free_share(core, a, b);
      const auto gap = [&](double s) { return signed_distance(core.shape, a + s * (b - a)).distance; };
      if (gap(0) <= 0) {
        CHECK(share == 1);
        continue;
      }
      double nearest = gap(0);
      for (int k = 0; k <= 200; ++k) nearest = std::min(nearest, gap(share * k / 200));
      CHECK(nearest > 0);
      if (share == 1) continue;
      ++cut;
      CHECK(gap(share) < 0.2 * core.depth);
    }
    CHECK(cut > 20);
  }
  CHECK_FALSE(core_of(PlaneShape{}, 2e-3));
}
