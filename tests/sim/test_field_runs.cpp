// Scalar fields over a run: what bounds them, what they keep, how far a step may go, resuming.
#include <doctest/doctest.h>

#include "sim/field_stability.h"
#include "sim/parallel.h"
#include "tests/sim/fields.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE("poisson goes with a load that varies, and is left alone by one that does not") {
  FieldProblem p;
  p.mesh = square(8);
  p.fixed = {boundary_of(p.mesh, constant(0))};
  p.source = constant(3);
  Field still(p, "");
  const Eigen::VectorXd u = still.value();
  must_step(still, 0.5, 2);
  CHECK(still.value() == u);
  CHECK(still.time() == 1);
  p.source = in_time([](const Vec3&, double t) { return 3 * (1 + t); });
  Field moving(p, "");
  CHECK(moving.value() == u);
  must_step(moving, 0.5, 2);
  CHECK((moving.value() - 2 * u).cwiseAbs().maxCoeff() <= 1e-14);
}

TEST_CASE("maximum principle: on right-angled triangles poisson and implicit heat stay within their data") {
  // Non-obtuse triangles make K an M-matrix (Ciarlet, Raviart 1973); so does lumped mass added to it.
  FieldProblem p;
  p.mesh = square(12);
  p.fixed = {boundary_of(p.mesh, steady([](const Vec3& x) { return std::sin(9 * x.x()) * std::cos(7 * x.z()); }))};
  const Field poisson(p, "");
  double low = 1e9, high = -1e9;
  for (int v : p.fixed[0].vertices) {
    low = std::min(low, poisson.value()(v));
    high = std::max(high, poisson.value()(v));
  }
  CHECK(poisson.value().minCoeff() >= low - 1e-14);
  CHECK(poisson.value().maxCoeff() <= high + 1e-14);
  p.equation = "heat";
  p.initial = steady([](const Vec3& x) { return x.norm() < 0.2 ? kHot : 0.0; });
  Field heat(p, "implicit-euler");
  low = std::min(low, 0.0);
  high = std::max(high, kHot);
  for (double h : {1e-4, 1e-2, 1.0}) {
    must_step(heat, h, 5);
    CHECK(heat.value().minCoeff() >= low - 1e-14);
    CHECK(heat.value().maxCoeff() <= high + 1e-14);
  }
}

TEST_CASE(
    "the energy of a wave: implicit Euler never gains, trapezoid and midpoint keep it, symplectic Euler stays within a "
    "band of order h") {
  const FieldProblem p = standing_mode("wave", square(12));
  const auto total = [](const Field& f) { return f.energies().kinetic + f.energies().potential; };
  {
    Field field(p, "implicit-euler");
    double before = total(field);
    for (int i = 0; i < 200; ++i) {
      must_step(field, 0.02, 1);
      CHECK(total(field) <= before * (1 + 1e-12));
      before = total(field);
    }
  }
  // Of a linear equation the trapezoid and the midpoint keep the energy; what is lost is the rounding of each solve.
  for (const char* name : {"newmark", "implicit-midpoint"}) {
    CAPTURE(name);
    Field field(p, name);
    const double start = total(field);
    must_step(field, 0.05, 400);
    CHECK(total(field) == doctest::Approx(start).scale(0).epsilon(1e-11));
  }
  // The modified energy that symplectic Euler keeps differs by (h/2) v^T K u, at most (h omega/2) E.
  const double omega = kPi * std::numbers::sqrt2;
  for (double h : {0.01, 0.005}) {
    Field field(p, "symplectic-euler");
    const double start = total(field);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      must_step(field, h, 1);
      worst = std::max(worst, std::abs(total(field) / start - 1));
    }
    CHECK(worst <= 1.1 * 0.5 * h * omega);
  }
}

TEST_CASE("values that rise with time at the boundary are met exactly: u = t under heat and as a wave") {
  for (const std::string equation : {"heat", "wave"})
    for (const MethodInfo& info : field_integrators(equation)) {
      const std::string name(info.name);
      CAPTURE(equation);
      CAPTURE(name);
      FieldProblem p;
      p.equation = equation;
      p.mesh = uneven_square(5);
      p.diffusivity = 0.01;
      p.speed = 0.1;
      p.fixed = {boundary_of(p.mesh, in_time([](const Vec3&, double t) { return t; }))};
      if (equation == "heat") p.source = constant(1);
      p.initial_rate = constant(1);
      Field field(p, name);
      must_step(field, 0.01, 50);
      CHECK((field.value().array() - 0.5).abs().maxCoeff() <= 1e-12);
      if (equation == "wave") CHECK((field.rate().array() - 1).abs().maxCoeff() <= 1e-10);
    }
}

TEST_CASE("the longest step of an explicit method is what theory says, and the run agrees") {
  // Limits of h lambda (heat) and h omega (wave), found by bisection on the method itself.
  const auto limit = [](const char* equation, const char* integrator) {
    double low = 0.1, high = 10;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (growth_of_a_step(equation, integrator, 1, middle) <= 1 + 1e-6 ? low : high) = middle;
    }
    return low;
  };
  for (const char* name : {"symplectic-euler", "symplectic-euler-position", "verlet", "leapfrog"})
    CHECK(limit("wave", name) == doctest::Approx(2).scale(0).epsilon(1e-3));
  CHECK(limit("wave", "rk4") == doctest::Approx(std::sqrt(8.0)).scale(0).epsilon(1e-3));
  for (const char* name : {"forward-euler", "heun", "midpoint"})
    CHECK(limit("heat", name) == doctest::Approx(2).scale(0).epsilon(1e-3));
  CHECK(limit("heat", "rk4") == doctest::Approx(2.785294).scale(0).epsilon(1e-3));
  CHECK(growth_of_a_step("wave", "implicit-euler", 1, 100) == 1);

  const FieldProblem p = standing_mode("wave", uneven_square(10));
  const Field field(p, "symplectic-euler");
  const double largest = field.largest_eigenvalue();
  const double exact = SemiDiscrete(field).eigenvalues().maxCoeff();
  CHECK(largest >= exact);         // with its margin
  CHECK(largest <= 1.06 * exact);  // and no more than that
  const double h = 2 / std::sqrt(exact);
  const auto after = [&](double step) {
    Field run(p, "symplectic-euler");
    for (int i = 0; i < 2000; ++i)
      if (!run.step(step).converged) return 1e300;
    return run.value().norm();
  };
  CHECK(after(0.98 * h) < 10 * field.value().norm());
  CHECK(after(1.02 * h) > 1e6 * field.value().norm());
  CHECK(step_holds("wave", "symplectic-euler", exact, 0.98 * h, 100));
  CHECK_FALSE(step_holds("wave", "symplectic-euler", exact, 1.02 * h, 100));
  const int steps = steps_that_hold("wave", "symplectic-euler", exact, 1, 100, 1000000);
  CHECK(steps == static_cast<int>(std::ceil(1 / h)));
  CHECK(steps_that_hold("wave", "symplectic-euler", 1e30, 1, 100, 1000) == 0);
}

TEST_CASE("a field that is resumed, and one with other threads, goes on with the same bits") {
  const int before = threads();
  for (const std::string equation : {"heat", "wave", "poisson"}) {
    std::vector<std::string> names = {""};
    if (equation != "poisson") {
      names.clear();
      for (const MethodInfo& info : field_integrators(equation)) names.emplace_back(info.name);
    }
    for (const std::string& name : names) {
      CAPTURE(equation);
      CAPTURE(name);
      FieldProblem p = standing_mode(equation, uneven_square(95));  // more vertices than a loop keeps to itself
      p.diffusivity = p.speed = 1e-3;
      p.source = in_time([](const Vec3& x, double t) { return x.x() * t; });
      set_threads(1);
      Field whole(p, name);
      must_step(whole, 0.01, 3);
      Field resumed(p, name);
      resumed.restore(whole.time(), whole.value(), whole.rate(), whole.memory());
      must_step(whole, 0.01, 3);
      set_threads(2);
      must_step(resumed, 0.01, 3);
      CHECK(resumed.value() == whole.value());
      CHECK(resumed.rate() == whole.rate());
      CHECK_THROWS_AS(resumed.restore(0, Eigen::VectorXd::Zero(3), whole.rate(), {}), std::invalid_argument);
    }
  }
  set_threads(before);
}
