// What a step promises beside its order: memory, sub-steps, masses, equilibrium.
#include <cmath>

#include "sim/free_bodies.h"
#include "sim/grids.h"
#include "sim/mass.h"
#include "tests/sim/derivatives.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

Model swinging_cloth(bool consistent) {
  TriangleMesh sheet = grid_sheet(1, 1, 4, 4);
  ModelBuilder builder;
  MembraneMaterial material{"stvk", 300, 0.3, 1e-2, 1e-3, BendingModel::kAuto, 0.5};
  material.consistent_mass = consistent;
  builder.add_membrane("cloth", sheet, material);
  builder.add_pin(pin_where(sheet.vertices, [](const Vec3& p) { return p.x() < -0.49; }));
  return builder.finish(Vec3(0, -9.81, 0), {0.2, 0.1, 1e-3}, {}, {});
}

Model bar(double young, const Motion& motion, int cells = 8) {
  const TetMesh mesh = block_of_tets(Vec3(1, 0.2, 0.2), cells, 2, 2);
  ModelBuilder builder;
  builder.add_solid("bar", mesh, {"stable-neo-hookean", young, 0.3, 1000});
  builder.add_pin(pin_where(mesh.vertices, [](const Vec3& p) { return p.x() < -0.499; }));
  Pin driven = pin_where(mesh.vertices, [](const Vec3& p) { return p.x() > 0.499; });
  driven.motion = motion;
  builder.add_pin(std::move(driven));
  return builder.finish(Vec3::Zero(), {}, {}, {});
}

}  // namespace

TEST_CASE("a run that is saved and goes on elsewhere has the same bits, for every integrator") {
  for (const MethodInfo& method : integrators()) {
    const std::string name(method.name);
    CAPTURE(name);
    SimulationSettings settings{name, "auto", {}, 2};
    if (name == "static") settings.load_time = 0.02;
    Simulation whole(swinging_cloth(false), settings);
    must_step(whole, 1.0 / 2000, 7);
    Simulation resumed(swinging_cloth(false), settings);
    resumed.restore(whole.state(), whole.memory());
    must_step(whole, 1.0 / 2000, 9);
    must_step(resumed, 1.0 / 2000, 9);
    CHECK(whole.state().x == resumed.state().x);
    CHECK(whole.state().v == resumed.state().v);
    CHECK(whole.memory() == resumed.memory());
    CHECK_THROWS_AS(resumed.restore({0, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3)}, whole.memory()),
                    std::invalid_argument);
  }
}

TEST_CASE("the consistent mass matrix is that of the elements: its total, its kinetic energy, its inverse") {
  const TetMesh block = block_of_tets(Vec3(1, 2, 0.5), 2, 3, 1);
  const TriangleMesh sheet = grid_sheet(1, 2, 2, 3);
  for (const bool solid : {true, false}) {
    ModelBuilder builder;
    SolidMaterial soft{"stable-neo-hookean", 1e5, 0.3, 700, true};
    MembraneMaterial cloth{"stvk", 1e5, 0.3, 1e-3, 0, BendingModel::kAuto, 0.4, true};
    if (solid)
      builder.add_solid("block", block, soft);
    else
      builder.add_membrane("sheet", sheet, cloth);
    const Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    const std::vector<std::uint8_t> held(static_cast<size_t>(3 * model.vertices()), 0);
    MassMatrix mass(model, held);
    const double total = solid ? 700.0 : 0.8;
    // A uniform velocity has the kinetic energy of the whole mass, a linear one v = A x that of its integral: for
    // v_x = x over a box of length L, m L^2/12 (exact for linear elements; lumped masses give more).
    Eigen::VectorXd ones = Eigen::VectorXd::Zero(3 * model.vertices()), linear = ones;
    for (int i = 0; i < model.vertices(); ++i) {
      ones(3 * i + 1) = 1;
      linear(3 * i + 1) = model.x0(3 * i);
    }
    CHECK(mass.energy(ones) == doctest::Approx(0.5 * total).scale(0).epsilon(1e-12));
    CHECK(mass.energy(linear) == doctest::Approx(0.5 * total / 12).scale(0).epsilon(1e-12));
    const Eigen::VectorXd f = random_vector(ones.size(), 1, 3);
    Eigen::VectorXd a = f, back = Eigen::VectorXd::Zero(f.size());
    mass.solve(a);
    mass.add_product(a, back);
    CHECK((back - f).norm() < 1e-12 * f.norm());
  }
}

TEST_CASE("with consistent mass free fall is the same, and every integrator keeps its order") {
  for (const char* integrator : {"newmark", "rk4", "verlet", "bdf2", "implicit-euler"}) {
    std::vector<Eigen::VectorXd> ends;
    for (const int steps : {400, 800, 1600}) {
      Simulation s(swinging_cloth(true), exact(integrator));
      must_step(s, 0.2 / steps, steps);
      Eigen::VectorXd z(2 * s.state().x.size());
      z << s.state().x, s.state().v / 10;
      ends.push_back(z);
    }
    // Differences of successive refinements fall by 2^p.
    const double order = std::log2((ends[0] - ends[1]).norm() / (ends[1] - ends[2]).norm());
    CAPTURE(integrator);
    for (const MethodInfo& method : integrators())
      if (method.name == integrator) CHECK(std::abs(order - method.order) < 0.1);
  }
}

TEST_CASE("a pin that turns far in one step is driven in sub-steps: the bar ends twisted") {
  // 270 degrees in one step; the straight way of the pinned face would be that of -90 degrees.
  const Motion twist({{0, {0, 0, 0}, {0, 0, 0}}, {1, {0, 0, 0}, {270, 0, 0}}}, {0.5, 0, 0});
  for (const char* integrator : {"implicit-euler", "static"}) {
    CAPTURE(integrator);
    SimulationSettings settings{integrator, "cholesky", {}, 6};
    settings.minimizer.max_iterations = 300;
    Simulation at_once(bar(1e5, twist), settings), slowly(bar(1e5, twist), settings);
    const StepReport r = at_once.step(1);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK(r.steps >= 3);
    must_step(slowly, 1.0 / 12, 12);
    if (std::string(integrator) == "static")
      // The same equilibrium, to the tolerance 1e-3 of each step's forces.
      CHECK(at_once.energies().elastic == doctest::Approx(slowly.energies().elastic).scale(0).epsilon(1e-2));
    // A quarter turn the other way holds a ninth of the energy of three: (90/270)^2.
    CHECK(at_once.energies().elastic > 0.5 * slowly.energies().elastic);
  }
}

TEST_CASE("bodies that an equilibrium cannot hold are named with the axes along which they are free") {
  const TetMesh mesh = block_of_tets(Vec3(1, 0.2, 0.2), 2, 1, 1);
  ModelBuilder builder;
  const BodyRange held = builder.add_solid("held", mesh, {});
  builder.add_solid("free", mesh, {});
  const BodyRange rail = builder.add_solid("rail", mesh, {});
  builder.add_pin({{held.first}, {true, true, true}, {}});
  builder.add_pin({{rail.first}, {false, true, false}, {}});
  builder.add_pin({{rail.first + 1}, {true, false, false}, {}});
  const std::vector<FreeBody> free = free_bodies(builder.finish(Vec3::Zero(), {}, {}, {}));
  REQUIRE(free.size() == 2);
  CHECK(free[0].name == "free");
  CHECK(free[0].axes == "x and y and z");
  CHECK(free[1].name == "rail");
  CHECK(free[1].axes == "z");
}

TEST_CASE("an equilibrium grows its loads over the clip and ends where damped motion ends") {
  const TetMesh mesh = block_of_tets(Vec3(0.5, 0.1, 0.1), 8, 2, 2);
  const auto model = [&](double alpha) {
    ModelBuilder builder;
    builder.add_solid("beam", mesh, {"stable-neo-hookean", 1e5, 0.3, 1000});
    builder.add_pin(pin_where(mesh.vertices, [](const Vec3& p) { return p.x() < -0.2499; }));
    return builder.finish(Vec3(0, -9.81, 0), {alpha, 0, 0}, {}, {});
  };
  SimulationSettings settings = exact("static");
  settings.load_time = 1;
  settings.minimizer.max_iterations = 300;
  settings.minimizer.tolerance = 1e-10;
  Simulation equilibrium(model(0), settings);
  must_step(equilibrium, 0.25, 4);
  CHECK(equilibrium.energies().kinetic == 0);
  Simulation motion(model(30), {"implicit-euler", "cholesky", {1e-10, 60}, 0});
  must_step(motion, 0.1, 300);
  const double sag = (equilibrium.state().x - equilibrium.model().x0).norm();
  CHECK((equilibrium.state().x - motion.state().x).norm() < 1e-7 * sag);
}

TEST_CASE("bdf2 starts anew, with a step of newmark, where a step is more than 2.4 times as long as the last") {
  const double h = 1.0 / 500;
  for (const double ratio : {2.0, 64.0}) {
    Simulation bdf2(swinging_cloth(false), exact("bdf2")), newmark(swinging_cloth(false), exact("newmark"));
    must_step(bdf2, h / ratio, 4);
    const Eigen::VectorXd before = bdf2.state().x;
    newmark.restore(bdf2.state(), newmark.memory());
    must_step(bdf2, h, 1);
    must_step(newmark, h, 1);
    CAPTURE(ratio);
    // Both solve the same step from different guesses, down to rounding: 16 eps (1 + beta omega^2) |y|, 1e-12 m of a
    // way of 1e-4 m. A step of bdf2's own is a part h^2 omega^2 away.
    const double apart = (bdf2.state().x - newmark.state().x).norm() / (newmark.state().x - before).norm();
    CHECK((apart < 1e-7) == (ratio > 2.4));
  }
}
