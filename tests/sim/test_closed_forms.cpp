// Closed forms that whole simulations must meet.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"
#include "tests/sim/derivatives.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

const Vec3 kGravity(0, -9.81, 0);

/// Steps until nothing moves any more, relative to `length` per second.
void must_settle(Simulation& s, double h, double length, int most) {
  for (int i = 0; i < most; ++i) {
    const StepReport r = s.step(h);
    REQUIRE_MESSAGE(r.converged, r.reason);
    if (s.state().v.cwiseAbs().maxCoeff() < 1e-7 * length) return;
  }
  FAIL("did not settle");
}

}  // namespace

TEST_CASE("free fall follows each method's own discrete parabola to rounding") {
  for (const char* integrator : {"implicit-euler", "symplectic-euler"}) {
    for (const char* linear : {"cholesky", "cg"}) {
      CAPTURE(integrator);
      CAPTURE(linear);
      ModelBuilder builder;
      const TetMesh cube = block_of_tets(Vec3(0.2, 0.2, 0.2), 2, 2, 2);
      const BodyRange body = builder.add_solid("cube", cube, {"stable-neo-hookean", 1e4, 0.4, 1000});
      builder.set_velocity(body, Vec3(1, 2, 3), Vec3::Zero());
      Simulation s(builder.finish(kGravity, {}, {}, {}), {integrator, linear, {1e-8, 60}, 0});
      const double h = 1.0 / 480;
      const int steps = 480;
      must_step(s, h, steps);
      // Both end a step with the velocity of its end: x_n = v t - g t (t + h)/2.
      const double t = h * steps;
      const Vec3 expected = Vec3(1, 2, 3) * t + 0.5 * kGravity * t * (t + h);
      CHECK((centre_of_mass(s) - expected).norm() < 1e-7);
      CHECK((momentum(s) / s.model().masses.sum() - (Vec3(1, 2, 3) + kGravity * t)).norm() < 1e-6);
    }
  }
}

TEST_CASE("a spinning body without forces keeps its linear momentum, at any stiffness") {
  for (double young : {1e4, 1e9}) {
    CAPTURE(young);
    ModelBuilder builder;
    const BodyRange body =
        builder.add_solid("bar", block_of_tets(Vec3(1, 0.2, 0.1), 5, 1, 1), {"stable-neo-hookean", young, 0.3, 1000});
    builder.set_velocity(body, Vec3(0.3, 0, -0.2), Vec3(1, 2, 3));
    Simulation s(builder.finish(Vec3::Zero(), {}, {}, {}), {"implicit-euler", "cholesky", {1e-3, 60}, 4});
    const Vec3 before = momentum(s);
    must_step(s, 1.0 / 120, 120);
    // Internal forces sum to zero up to rounding of the stresses: eps * young * area per step.
    CHECK((momentum(s) - before).norm() < 1e-9 * before.norm() * (young / 1e4));
  }
}

TEST_CASE("a stiff spinning body falls as fast as a soft one") {
  // The residual test is relative: forces of the spin must not hide gravity.
  ModelBuilder builder;
  const BodyRange body =
      builder.add_solid("bar", block_of_tets(Vec3(1, 0.2, 0.1), 5, 1, 1), {"stable-neo-hookean", 1e9, 0.3, 1000});
  builder.set_velocity(body, Vec3::Zero(), Vec3(0, 0, 10));
  Simulation s(builder.finish(kGravity, {}, {}, {}), {"implicit-euler", "cg", {1e-3, 60}, 4});
  const double h = 1.0 / 240;
  must_step(s, h, 240);
  CHECK(centre_of_mass(s).y() == doctest::Approx(0.5 * kGravity.y() * (1 + h)).scale(0).epsilon(1e-3));
}

TEST_CASE("pins hold to the bit, whatever solves the system") {
  const TetMesh beam = block_of_tets(Vec3(0.5, 0.1, 0.1), 10, 2, 2);
  for (const char* linear : {"cholesky", "cg", "auto"}) {
    ModelBuilder builder;
    builder.add_solid("beam", beam, {"stable-neo-hookean", 1e5, 0.4, 1000});
    builder.add_pin(pin_where(beam.vertices, [](const Vec3& p) { return p.x() < -0.2499; }));
    Pin rail = pin_where(beam.vertices, [](const Vec3& p) { return p.x() > 0.2499; });
    rail.axes[0] = rail.axes[1] = false;
    builder.add_pin(rail);
    Simulation s(builder.finish(kGravity, {}, {}, {}), {"implicit-euler", linear, {}, 6});
    must_step(s, 1.0 / 60, 20);
    for (int i = 0; i < s.model().vertices(); ++i) {
      const Vec3 x = s.state().x.segment<3>(3 * i), x0 = s.model().x0.segment<3>(3 * i);
      if (x0.x() < -0.2499) CHECK(x == x0);
      if (x0.x() > 0.2499) {
        CHECK(x.z() == x0.z());
        CHECK(x.y() < x0.y());
      }
    }
  }
}

TEST_CASE("an oscillator of one spring has its period, and symplectic Euler keeps its amplitude") {
  const double k = 40, period = 2 * std::numbers::pi * std::sqrt(0.5 / k);
  TriangleMesh pair;  // no triangles: two points with masses given by hand
  pair.vertices = {Vec3(0, 0, 0), Vec3(1.1, 0, 0)};
  ModelBuilder builder;
  builder.add_mass_spring("oscillator", pair, {{0, 1, k, 1.0}}, 1, 0);
  builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.masses.setConstant(0.5);
  Simulation s(std::move(model), {"symplectic-euler", "auto", {}, 0});
  const double h = period / 2000;
  double largest = 0;
  int crossings = 0;
  double last = 0.1, first_crossing = 0, last_crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    REQUIRE(s.step(h).converged);
    const double u = s.state().x(3) - 1.0;
    largest = std::max(largest, std::abs(u));
    if (last > 0 && u <= 0) {
      const double t = s.state().t - h * u / (u - last);
      if (++crossings == 1) first_crossing = t;
      last_crossing = t;
    }
    last = u;
  }
  REQUIRE(crossings == 10);
  // The method's own period is shorter by (h omega)^2/24, its amplitude larger by at most h omega/2.
  CHECK((last_crossing - first_crossing) / 9 == doctest::Approx(period).scale(0).epsilon(1e-5));
  CHECK(largest == doctest::Approx(0.1).scale(0).epsilon(2e-3));
}

TEST_CASE("implicit Euler damps the oscillator as its amplification factor says") {
  const double k = 40, m = 0.5, omega = std::sqrt(k / m), h = 0.05 / omega;
  TriangleMesh pair;
  pair.vertices = {Vec3(0, 0, 0), Vec3(1.1, 0, 0)};
  ModelBuilder builder;
  builder.add_mass_spring("oscillator", pair, {{0, 1, k, 1.0}}, 1, 0);
  builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.masses.setConstant(m);
  Simulation s(std::move(model), {"implicit-euler", "cholesky", {1e-10, 60}, 0});
  const double e0 = s.energies().kinetic + s.energies().elastic;
  must_step(s, h, 400);
  const double expected = e0 * std::pow(1 / (1 + h * omega * h * omega), 400);
  CHECK(s.energies().kinetic + s.energies().elastic == doctest::Approx(expected).scale(0).epsilon(1e-6));
}

TEST_CASE("drag slows a projectile by the method's own factor") {
  ModelBuilder builder;
  const BodyRange body =
      builder.add_solid("ball", block_of_tets(Vec3(0.1, 0.1, 0.1), 1, 1, 1), {"corotated-volume", 1e5, 0.3, 1000});
  builder.set_velocity(body, Vec3(5, 0, 0), Vec3::Zero());
  Simulation s(builder.finish(Vec3::Zero(), {0.5, 0.3, 0}, {}, {}), {"implicit-euler", "cholesky", {1e-10, 60}, 0});
  must_step(s, 0.01, 100);
  CHECK(s.state().v(0) == doctest::Approx(5 / std::pow(1 + 0.01 * 0.8, 100)).scale(0).epsilon(1e-8));
  CHECK(s.energies().dissipated > 0);
}

TEST_CASE("a bar under its own weight sinks by rho g L^2 / 2E, mean over its end") {
  const double L = 1, E = 1e7, rho = 1000;  // rho g L/E = 1e-3
  for (const char* material : {"stable-neo-hookean", "corotated-volume"}) {
    CAPTURE(material);
    const TetMesh bar = block_of_tets(Vec3(0.2, L, 0.2), 2, 10, 2);
    ModelBuilder builder;
    builder.add_solid("bar", bar, {material, E, 0.0, rho});
    builder.add_pin(pin_where(bar.vertices, [&](const Vec3& p) { return p.y() > L / 2 - 1e-9; }));
    Simulation s(builder.finish(kGravity, {20, 0, 0}, {}, {}), {"implicit-euler", "cholesky", {1e-8, 60}, 0});
    must_settle(s, 0.05, 1, 400);
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < bar.vertices.size(); ++i)
      if (bar.vertices[i].y() < -L / 2 + 1e-9) {
        sum += s.state().x(3 * static_cast<int>(i) + 1) + L / 2;
        ++count;
      }
    // nu = 0: linear elements give the exact end displacement of the linear problem up to what the unevenly lumped
    // weight of the pinned layer's neighbours and the finite strain of 1e-3 change.
    CHECK(sum / count == doctest::Approx(-rho * 9.81 * L * L / (2 * E)).scale(0).epsilon(3e-3));
  }
}

TEST_CASE("a cantilever sags by its right 1e-5 m also at Young 1e9") {
  // The step is 1e-5 m in all: a test on its absolute size would stop before anything moved. Linear tetrahedra are
  // too stiff in bending, so the sag is compared with that of the same mesh at Young 1e6, which is 1000 times larger.
  const auto sag = [](double young) {
    const double L = 0.5, side = 0.2;
    const TetMesh beam = block_of_tets(Vec3(L, side, side), 10, 4, 4);
    ModelBuilder builder;
    builder.add_solid("beam", beam, {"stable-neo-hookean", young, 0.3, 1000});
    builder.add_pin(pin_where(beam.vertices, [&](const Vec3& p) { return p.x() < -L / 2 + 1e-9; }));
    Simulation s(builder.finish(kGravity, {}, {}, {}), {"implicit-euler", "auto", {1e-3, 60}, 6});
    must_step(s, 1.0 / 60, 240);
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < beam.vertices.size(); ++i)
      if (beam.vertices[i].x() > L / 2 - 1e-9) {
        sum += beam.vertices[i].y() - s.state().x(3 * static_cast<int>(i) + 1);
        ++count;
      }
    return sum / count;
  };
  const double soft = sag(1e6), stiff = sag(1e9);
  // Timoshenko: q L^4/8EI + q L^2/2kGA with k = 10(1+nu)/(12+11nu).
  const double q = 1000 * 9.81 * 0.04, I = std::pow(0.2, 4) / 12, k = 13.0 / 15.3, G = 1e9 / 2.6;
  const double timoshenko = q * std::pow(0.5, 4) / (8 * 1e9 * I) + q * 0.25 / (2 * k * G * 0.04);
  MESSAGE("sag at Young 1e9: ", stiff, " m; Timoshenko: ", timoshenko, " m; ratio ", stiff / timoshenko);
  CHECK(stiff == doctest::Approx(soft / 1000).scale(0).epsilon(0.01));
  CHECK(stiff < timoshenko);  // locking only stiffens
  CHECK(stiff > 0.7 * timoshenko);
}

TEST_CASE("a block at rest on a plane is carried with its weight, within the contact distance") {
  ModelBuilder builder;
  TetMesh block = block_of_tets(Vec3(0.2, 0.1, 0.2), 4, 2, 4);
  for (Vec3& v : block.vertices) v.y() += 0.0515;
  builder.add_solid("block", block, {"stable-neo-hookean", 1e6, 0.3, 1000});
  Collider plane;
  plane.friction = 0.4;
  Simulation s(builder.finish(kGravity, {}, {plane}, {2e-3, 1e-3, 0}), {"implicit-euler", "auto", {1e-4, 60}, 6});
  must_step(s, 1.0 / 120, 240);
  CHECK(s.energies().kinetic < 1e-10);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(s.state().x.size());
  s.model().contact->add_gradient(s.state().x, force);
  double carried = 0;
  for (int i = 0; i < s.model().vertices(); ++i) carried -= force(3 * i + 1);
  CHECK(carried == doctest::Approx(s.model().masses.sum() * 9.81).scale(0).epsilon(1e-3));
  const ContactReport contact = s.model().contact->report(s.state().x);
  CHECK(contact.active == 25);
  CHECK(contact.smallest > 0);
  CHECK(contact.smallest < 2e-3);
}

TEST_CASE("a sliding block stops after v^2 / 2 mu g") {
  for (const double mu : {0.2, 0.5}) {
    ModelBuilder builder;
    TetMesh block = block_of_tets(Vec3(0.2, 0.05, 0.2), 4, 1, 4);
    for (Vec3& v : block.vertices) v.y() += 0.025 + 0.002;
    const BodyRange body = builder.add_solid("block", block, {"stable-neo-hookean", 1e7, 0.3, 1000});
    const double v = 1.0, h = 1.0 / 480;
    builder.set_velocity(body, Vec3(v, 0, 0), Vec3::Zero());
    Collider plane;
    plane.friction = mu;
    Simulation s(builder.finish(kGravity, {}, {plane}, {2e-3, 1e-3, 0}), {"implicit-euler", "auto", {1e-4, 60}, 6});
    const double start = centre_of_mass(s).x();
    must_step(s, h, 480);
    const double expected = v * v / (2 * mu * 9.81);
    const double slid = centre_of_mass(s).x() - start;
    CAPTURE(mu);
    // h v/2 from the method; the normal force of the start, lagged by a step, comes h later: h v more.
    CHECK(slid == doctest::Approx(expected).scale(0).epsilon((1.5 * h * v + 1e-3) / expected));
    // Below the slip speed what is left creeps to rest: D'(u) = 2 mu lambda u / slip_speed.
    CHECK(std::abs(momentum(s).x() / s.model().masses.sum()) < 1e-3);
  }
}

TEST_CASE("driven pins and colliders are where their script says, and drag along what touches them") {
  const TriangleMesh sheet = grid_sheet(1, 1, 6, 6);
  for (const char* integrator : {"implicit-euler", "symplectic-euler"}) {
    ModelBuilder builder;
    builder.add_membrane("sheet", sheet, {"stvk", 1e4, 0.3, 1e-3, 1e-5, BendingModel::kAuto, 0.2});
    Pin pin = pin_where(sheet.vertices, [](const Vec3& p) { return p.x() < -0.49; });
    pin.motion = Motion({{0, {0, 0, 0}, {0, 0, 0}}, {1, {0, 0.5, 0}, {0, 0, 360}}}, {-0.5, 0, 0});
    const std::vector<int> held = pin.vertices;
    builder.add_pin(std::move(pin));
    Simulation s(builder.finish(kGravity, {}, {}, {}), {integrator, "auto", {}, 6});
    must_step(s, 1.0 / 1000, 500);
    CHECK(s.state().x(3 * held[0] + 1) == doctest::Approx(0.25));
    CHECK(s.state().v(3 * held[0] + 1) == doctest::Approx(0.5));
    CHECK(s.state().x(3 * held[0]) == doctest::Approx(-0.5));
  }
  ModelBuilder builder;
  TetMesh block = block_of_tets(Vec3(0.1, 0.1, 0.1), 2, 2, 2);
  for (Vec3& v : block.vertices) v.y() += 0.0515;
  builder.add_solid("block", block, {"stable-neo-hookean", 1e6, 0.3, 1000});
  Collider belt;
  belt.friction = 0.8;
  belt.motion = Motion({{0, {0, 0, 0}, {0, 0, 0}}, {2, {1, 0, 0}, {0, 0, 0}}}, {0, 0, 0});
  Simulation s(builder.finish(kGravity, {}, {belt}, {}), {"implicit-euler", "auto", {1e-4, 60}, 6});
  must_step(s, 1.0 / 240, 240);
  CHECK(momentum(s).x() / s.model().masses.sum() == doctest::Approx(0.5).scale(0).epsilon(0.01));
}

TEST_CASE("a step that cannot converge is halved, then refused with the state untouched") {
  ModelBuilder builder;
  TetMesh block = block_of_tets(Vec3(0.1, 0.1, 0.1), 2, 2, 2);
  builder.add_solid("block", block, {"stable-neo-hookean", 1e6, 0.45, 1000});
  Model model = builder.finish(kGravity, {}, {}, {});
  model.x0 += random_vector(model.x0.size(), 0.05, 3);  // in a bad way: one iteration will not do
  Simulation s(std::move(model), {"implicit-euler", "cholesky", {1e-12, 1}, 2});
  const StepReport r = s.step(1.0 / 30);
  CHECK_FALSE(r.converged);
  CHECK(r.retries >= 1);
  CHECK(r.reason.find("block") != std::string::npos);
  CHECK(s.state().t == 0);
  CHECK(s.state().x == s.model().x0);
}

TEST_CASE("an explicit step beyond the stability limit ends in a refusal, not in NaN") {
  ModelBuilder builder;
  builder.add_solid("block", block_of_tets(Vec3(0.1, 0.1, 0.1), 2, 2, 2), {"stable-neo-hookean", 1e9, 0.3, 1000});
  Model model = builder.finish(kGravity, {}, {}, {});
  model.v0 = random_vector(model.x0.size(), 0.1, 3);
  Simulation s(std::move(model), {"symplectic-euler", "auto", {}, 0});
  StepReport r;
  for (int i = 0; i < 1000 && r.converged; ++i) {
    r = s.step(1.0 / 60);
    REQUIRE(s.state().x.allFinite());
  }
  CHECK_FALSE(r.converged);
  CHECK(r.reason.find("explicit") != std::string::npos);
}

TEST_CASE("explicit integration never assembles, and an unloaded scene never evaluates contact") {
  ModelBuilder builder;
  builder.add_solid("block", block_of_tets(Vec3(0.1, 0.1, 0.1), 2, 2, 2), {"stable-neo-hookean", 1e4, 0.3, 1000});
  Simulation s(builder.finish(kGravity, {0.1, 0, 1e-4}, {}, {}), {"symplectic-euler", "auto", {}, 0});
  const StepReport r = s.step(1e-4);
  CHECK(r.converged);
  CHECK(r.hessians == 0);
  CHECK(r.newton_iterations == 0);
  CHECK(r.contact_evaluations == 0);
  CHECK(r.seconds.assemble == 0);
  CHECK(r.seconds.contact == 0);
}
