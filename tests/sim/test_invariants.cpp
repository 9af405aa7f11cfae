// What each integrator keeps, and how what it does not keep goes with the step.
#include <Eigen/Geometry>

#include <cmath>
#include <set>

#include "sim/grids.h"
#include "tests/sim/derivatives.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

/// A soft body that spins and breathes, free of outer forces.
Model spinning_body() {
  const TetMesh mesh = block_of_tets(Vec3(1, 0.6, 0.4), 2, 1, 1);
  ModelBuilder builder;
  const BodyRange body = builder.add_solid("body", mesh, {"stable-neo-hookean", 2e4, 0.3, 1000});
  builder.set_velocity(body, Vec3(0.3, -0.2, 0.5), Vec3(2, 3, 4));
  return builder.finish(Vec3::Zero(), {}, {}, {});
}

Model spring_pendulum() {
  TriangleMesh pair;
  pair.vertices = {Vec3(0, 0, 0), Vec3(0.8, -0.6, 0)};
  ModelBuilder builder;
  builder.add_mass_spring("pendulum", pair, {{0, 1, 100, 0.9}}, 1, 0);
  builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.masses.setConstant(0.5);
  model.v0(5) = 0.7;
  return model;
}

const std::set<std::string> kKeepAngularMomentum = {"symplectic-euler", "symplectic-euler-position", "verlet",
                                                    "leapfrog", "implicit-midpoint"};

}  // namespace

TEST_CASE("every integrator keeps linear momentum to rounding") {
  for (const MethodInfo& method : integrators()) {
    if (method.order == 0) continue;
    Simulation s(spinning_body(), exact(std::string(method.name)));
    const Vec3 before = momentum(s);
    must_step(s, 1.0 / 2000, 200);
    CAPTURE(std::string(method.name));
    // Stresses of 1e4 Pa on faces of 0.3 m^2, rounded 200 times for 1/2000 s: some 1e-13 N s of 120.
    CHECK((momentum(s) - before).norm() < 1e-10 * before.norm());
  }
}

TEST_CASE("angular momentum is kept by the methods that keep it, and drifts with the order of the others") {
  const auto drift = [](const std::string& integrator, int steps) {
    Simulation s(spinning_body(), exact(integrator));
    const Vec3 before = angular_momentum(s);
    must_step(s, 0.2 / steps, steps);
    return (angular_momentum(s) - before).norm() / before.norm();
  };
  for (const MethodInfo& method : integrators()) {
    if (method.order == 0) continue;
    const std::string name(method.name);
    CAPTURE(name);
    if (kKeepAngularMomentum.count(name) == 1) {
      CHECK(drift(name, 400) < 1e-10);
      continue;
    }
    // A Runge-Kutta method of order p can do better than its order for a quadratic quantity, never worse.
    const double coarse = drift(name, 400), fine = drift(name, 800);
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(fine > 1e-13);
    CHECK(std::log2(coarse / fine) > method.order - 0.1);
  }
}

TEST_CASE("energy: symplectic methods do not drift, and all err with their order") {
  const double period = 2 * 3.14159265 * std::sqrt(0.5 / 100);
  const auto errors = [&](const std::string& integrator, int steps_per_period, int periods) {
    Simulation s(spring_pendulum(), exact(integrator));
    const double before = total_energy(s);
    std::vector<double> e;
    for (int i = 0; i < steps_per_period * periods; ++i) {
      must_step(s, period / steps_per_period, 1);
      e.push_back((total_energy(s) - before) / before);
    }
    return e;
  };
  const auto largest = [](auto begin, auto end) {
    double most = 0;
    for (auto it = begin; it != end; ++it) most = std::max(most, std::abs(*it));
    return most;
  };
  for (const char* name : {"symplectic-euler", "symplectic-euler-position", "verlet", "leapfrog"}) {
    CAPTURE(name);
    const std::vector<double> e = errors(name, 60, 400);
    // The error is that of a nearby energy, which is kept: it wavers, and the last tenth wavers as the first did.
    const double first = largest(e.begin(), e.begin() + e.size() / 10);
    CHECK(largest(e.end() - static_cast<std::ptrdiff_t>(e.size() / 10), e.end()) < 1.1 * first);
    CHECK(first > 1e-6);
  }
  for (const MethodInfo& method : integrators()) {
    if (method.order == 0) continue;
    CAPTURE(std::string(method.name));
    const std::vector<double> coarse = errors(std::string(method.name), 600, 2),
                              fine = errors(std::string(method.name), 1200, 2);
    CHECK(std::log2(largest(coarse.begin(), coarse.end()) / largest(fine.begin(), fine.end())) > method.order - 0.1);
  }
}

// Where E is convex implicit Euler cannot gain: K' - K <= v'.M (v' - v) = -(y - x).grad E(y) <= E(x) - E(y).
// A spring that swings through its slack is not convex; there it gained up to 3e-6 of its energy in a step.
TEST_CASE("implicit Euler never gains energy on a stiff pendulum at h omega = 10") {
  TriangleMesh pair;
  pair.vertices = {Vec3(0, 0, 0), Vec3(0.8, -0.6, 0)};
  ModelBuilder builder;
  builder.add_mass_spring("pendulum", pair, {{0, 1, 5e4, 1.0}}, 1, 0);
  builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.masses.setConstant(0.5);
  model.v0 << 0, 0, 0, 1.8, 2.4, 0.7;
  Simulation s(std::move(model), exact("implicit-euler"));
  const double h = 10 / std::sqrt(5e4 / 0.5);
  double last = total_energy(s);
  for (int i = 0; i < 300; ++i) {
    must_step(s, h, 1);
    CHECK(total_energy(s) <= last * (1 + 1e-12));
    last = total_energy(s);
  }
}

TEST_CASE("the result does not depend on direction, numbering or units") {
  // A cantilever and a hung sheet under gravity, to tolerance 1e-12 with a direct solver.
  struct Change {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    bool renumber = false;
    double unit = 1;  // new units per metre
  };
  const auto run = [](const Change& c, const char* integrator) {
    const auto order = [&](size_t count) {
      std::vector<size_t> new_of_old(count);
      for (size_t i = 0; i < count; ++i) new_of_old[i] = c.renumber ? (i * 7 + 3) % count : i;
      return new_of_old;
    };
    const auto change = [&](auto mesh, auto& cells, const std::vector<size_t>& new_of_old) {
      auto moved = mesh;
      for (size_t i = 0; i < mesh.vertices.size(); ++i)
        moved.vertices[new_of_old[i]] = c.unit * (c.R * mesh.vertices[i]);
      for (size_t e = 0; e < cells.size(); ++e)
        for (size_t a = 0; a < cells[e].size(); ++a)
          cells[e][a] = static_cast<int>(new_of_old[static_cast<size_t>(cells[e][a])]);
      return moved.vertices;
    };
    TetMesh beam = block_of_tets(Vec3(0.5, 0.1, 0.1), 5, 1, 1);
    TriangleMesh sheet = grid_sheet(0.6, 0.6, 5, 5);
    const auto held = [](const Vec3& p) { return p.x() < -0.2499; };
    const Pin beam_pin = pin_where(beam.vertices, held), sheet_pin = pin_where(sheet.vertices, held);
    const auto beam_order = order(beam.vertices.size()), sheet_order = order(sheet.vertices.size());
    beam.vertices = change(beam, beam.tets, beam_order);
    sheet.vertices = change(sheet, sheet.triangles, sheet_order);
    const double u = c.unit;
    ModelBuilder builder;
    const BodyRange first = builder.add_solid("beam", beam, {"stable-neo-hookean", 5e4 / u, 0.3, 1000 / (u * u * u)});
    const BodyRange second = builder.add_membrane(
        "sheet", sheet, {"stvk", 1e4 / u, 0.3, 1e-3 * u, 1e-4 * u * u, BendingModel::kAuto, 0.3 / (u * u)});
    Pin pin;
    for (int v : beam_pin.vertices)
      pin.vertices.push_back(first.first + static_cast<int>(beam_order[static_cast<size_t>(v)]));
    for (int v : sheet_pin.vertices)
      pin.vertices.push_back(second.first + static_cast<int>(sheet_order[static_cast<size_t>(v)]));
    builder.add_pin(std::move(pin));
    SimulationSettings settings = exact(integrator);
    settings.minimizer.tolerance = 1e-12;
    Simulation s(builder.finish(u * (c.R * Vec3(0, -9.81, 0)), {0.1, 0, 1e-3}, {}, {}), settings);
    must_step(s, 1.0 / 120, 30);
    Eigen::VectorXd x(s.state().x.size());  // back in the first numbering, direction and units
    const auto back = [&](const BodyRange& body, const std::vector<size_t>& new_of_old) {
      for (size_t i = 0; i < new_of_old.size(); ++i)
        x.segment<3>(3 * (body.first + static_cast<int>(i))) =
            c.R.transpose() * s.state().x.segment<3>(3 * (body.first + static_cast<int>(new_of_old[i]))) / u;
    };
    back(first, beam_order);
    back(second, sheet_order);
    return x;
  };
  for (const char* integrator : {"implicit-euler", "newmark", "bdf2"}) {
    const Eigen::VectorXd plain = run({}, integrator);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(10 * 3.14159265358979 / 180, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    CAPTURE(integrator);
    CHECK((run({R, false, 1}, integrator) - plain).norm() < 1e-8 * plain.norm());
    CHECK((run({Eigen::Matrix3d::Identity(), true, 1}, integrator) - plain).norm() < 1e-8 * plain.norm());
    CHECK((run({Eigen::Matrix3d::Identity(), false, 10}, integrator) - plain).norm() < 1e-8 * plain.norm());
    CHECK((run({R, true, 0.1}, integrator) - plain).norm() < 1e-8 * plain.norm());
  }
}
