// All minimizers find the same minimum, say what stopped them, and say so when they cannot.
#include <cmath>

#include "sim/grids.h"
#include "tests/sim/derivatives.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

Model soft_beam() {
  const TetMesh beam = block_of_tets(Vec3(0.5, 0.1, 0.1), 6, 2, 2);
  ModelBuilder builder;
  builder.add_solid("beam", beam, {"stable-neo-hookean", 2e4, 0.3, 1000});
  builder.add_pin(pin_where(beam.vertices, [](const Vec3& p) { return p.x() < -0.2499; }));
  return builder.finish(Vec3(0, -9.81, 0), {0.1, 0, 1e-3}, {}, {});
}

SimulationSettings settings(const char* method, const char* hessian, const char* search, const char* stop,
                            double tolerance) {
  SimulationSettings s{"implicit-euler", "cholesky", {}, 0};
  s.minimizer.method = method;
  s.minimizer.hessian = hessian;
  s.minimizer.line_search = search;
  s.minimizer.stop = stop;
  s.minimizer.tolerance = tolerance;
  s.minimizer.max_iterations = 20000;
  return s;
}

}  // namespace

TEST_CASE("every minimizer with every Hessian, line search and stopping test finds the same motion") {
  const double tolerance = 1e-7;
  // Short steps have h omega_max below 1: fixed-point iteration converges too. In long ones Newton's method does not
  // reach rounding, which ends any solve, at once.
  const double short_step = 1.0 / 2000, long_step = 1.0 / 20;
  const auto end = [](double h) {
    Simulation s(soft_beam(), exact("implicit-euler"));
    must_step(s, h, 20);
    return s.state().x;
  };
  const Eigen::VectorXd short_end = end(short_step), long_end = end(long_step);
  const auto check = [&](const char* method, const char* hessian, const char* search, const char* stop) {
    const bool newton = std::string(method) == "newton";
    const double h = newton ? long_step : short_step;
    const Eigen::VectorXd& reference = newton ? long_end : short_end;
    CAPTURE(std::string(method));
    CAPTURE(std::string(hessian));
    CAPTURE(std::string(search));
    CAPTURE(std::string(stop));
    Simulation s(soft_beam(), settings(method, hessian, search, stop, tolerance));
    int by_test = 0, by_rounding = 0;
    for (int i = 0; i < 20; ++i) {
      const StepReport r = s.step(h);
      REQUIRE_MESSAGE(r.converged, r.reason);
      by_test += r.stopped_by == stop ? 1 : 0;
      by_rounding += r.stopped_by == "rounding" ? 1 : 0;
    }
    CHECK(by_test > 0);
    CHECK(by_test + by_rounding == 20);
    // Each step leaves tolerance of its forces, up to 20 of which add up; the step test of a method that converges
    // linearly leaves a multiple of its last step.
    CHECK((s.state().x - reference).norm() < 100 * tolerance * (reference - s.model().x0).norm());
  };
  for (const char* search : {"backtracking", "exact"}) {
    for (const char* hessian : {"clamped", "shifted"})
      for (const char* stop : {"residual", "decrement", "step"}) check("newton", hessian, search, stop);
    check("gradient-descent", "auto", search, "residual");
  }
  for (const char* stop : {"residual", "step"}) check("fixed-point", "auto", "backtracking", stop);
}

TEST_CASE("every minimizer minimizes with every implicit method, within its own range") {
  for (const char* integrator : {"implicit-euler", "newmark", "implicit-midpoint", "bdf2"}) {
    Simulation reference(soft_beam(), exact(integrator));
    must_step(reference, 1.0 / 2000, 10);
    for (const char* method : {"newton", "gradient-descent", "fixed-point"}) {
      CAPTURE(std::string(integrator));
      CAPTURE(std::string(method));
      SimulationSettings s = settings(method, "auto", "backtracking", "residual", 1e-7);
      s.integrator = integrator;
      Simulation simulation(soft_beam(), s);
      must_step(simulation, 1.0 / 2000, 10);
      CHECK((simulation.state().x - reference.state().x).norm() <
            1e-5 * (reference.state().x - reference.model().x0).norm());
    }
  }
}

TEST_CASE("fixed-point iteration converges up to the h omega of theory, says when it cannot, and what would do") {
  // One spring along x: omega is known.
  const double k = 50, m = 0.5, omega = std::sqrt(k / m);
  const auto oscillator = [&](const char* integrator, double h_omega) {
    TriangleMesh pair;
    pair.vertices = {Vec3(0, 0, 0), Vec3(1.1, 0, 0)};
    ModelBuilder builder;
    builder.add_mass_spring("oscillator", pair, {{0, 1, k, 1.0}}, 1, 0);
    builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
    Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    model.masses.setConstant(m);
    SimulationSettings s = settings("fixed-point", "auto", "backtracking", "residual", 1e-10);
    s.integrator = integrator;
    Simulation simulation(std::move(model), s);
    StepReport r;
    // bdf2 starts with a step of newmark's, which has a wider range.
    for (int i = 0; i < 3 && r.converged; ++i) r = simulation.step(h_omega / omega);
    return r;
  };
  for (const auto& [integrator, limit] : std::vector<std::pair<const char*, double>>{
           {"implicit-euler", 1}, {"newmark", 2}, {"implicit-midpoint", 2}, {"bdf2", 1.5}}) {
    CAPTURE(std::string(integrator));
    CHECK(oscillator(integrator, 0.98 * limit).converged);
    const StepReport r = oscillator(integrator, 1.02 * limit);
    CHECK_FALSE(r.converged);
    CHECK(r.reason.find("does not converge") != std::string::npos);
    CHECK(r.reason.find("1.04") != std::string::npos);  // the factor, 1.02^2
  }
}

TEST_CASE("a solve that starts at rest stops at once, at rounding, for any Young's modulus") {
  for (const double young : {1e2, 1e5, 1e9, 1e12}) {
    ModelBuilder builder;
    builder.add_solid("block", block_of_tets(Vec3(1, 1, 1), 2, 2, 2), {"stable-neo-hookean", young, 0.45, 1000});
    Simulation s(builder.finish(Vec3::Zero(), {}, {}, {}), {"implicit-euler", "cholesky", {}, 0});
    const StepReport r = s.step(1.0 / 60);
    CAPTURE(young);
    CHECK(r.converged);
    CHECK(r.newton_iterations == 0);
    CHECK(r.stopped_by == "rounding");
  }
}

TEST_CASE("settings that do not go together are refused with a reason") {
  CHECK_THROWS_WITH_AS(Simulation(soft_beam(), settings("gradient-descent", "auto", "exact", "decrement", 1e-3)),
                       doctest::Contains("residual or step"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(Simulation(soft_beam(), settings("gradient-descent", "auto", "exact", "step", 1e-3)),
                       doctest::Contains("stops by residual"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(Simulation(soft_beam(), settings("fixed-point", "auto", "exact", "residual", 1e-3)),
                       doctest::Contains("no line search"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(Simulation(soft_beam(), settings("newtom", "auto", "exact", "residual", 1e-3)),
                       doctest::Contains("there are newton, gradient-descent, fixed-point"), std::invalid_argument);
  SimulationSettings s = settings("fixed-point", "auto", "backtracking", "residual", 1e-3);
  s.integrator = "static";
  CHECK(Simulation(soft_beam(), s).step(1).reason.find("equilibrium") != std::string::npos);
}

TEST_CASE("a linear solver that does not converge ends the step with its reason, not with a larger shift") {
  const TetMesh beam = block_of_tets(Vec3(0.5, 0.1, 0.1), 8, 3, 3);
  ModelBuilder builder;
  builder.add_solid("beam", beam, {"stable-neo-hookean", 1e7, 0.3, 1000});
  builder.add_pin(pin_where(beam.vertices, [](const Vec3& p) { return p.x() < -0.2499; }));
  Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {"implicit-euler", "jacobi", {}, 0});
  const StepReport r = s.step(1.0 / 60);
  CHECK_FALSE(r.converged);
  CHECK(r.reason.find("jacobi does not converge") != std::string::npos);
}

TEST_CASE("a matrix that is singular is shifted until it is not: a free body finds its equilibrium") {
  for (const char* hessian : {"clamped", "shifted"}) {
    ModelBuilder builder;
    builder.add_solid("block", block_of_tets(Vec3(1, 1, 1), 3, 3, 3), {"stable-neo-hookean", 1e5, 0.3, 1000});
    Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    model.x0 += random_vector(model.x0.size(), 0.1, 7);
    SimulationSettings s = settings("newton", hessian, "backtracking", "residual", 1e-10);
    s.integrator = "static";
    s.minimizer.max_iterations = 300;
    Simulation simulation(std::move(model), s);
    must_step(simulation, 1, 1);
    // E = mu strain^2 and forces of tolerance times the first: the energy left is of the order of its square.
    CAPTURE(std::string(hessian));
    CHECK(std::abs(simulation.energies().elastic) < 1e-9 * 1e5);
  }
}
