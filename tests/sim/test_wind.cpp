// Wind and what it does to surfaces.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"
#include "sim/wind.h"
#include "tests/sim/derivatives.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

Vec3 force_on(const EnergyTerm& term, const Eigen::VectorXd& v) {
  Eigen::VectorXd g = Eigen::VectorXd::Zero(v.size());
  term.add_gradient(v, g);
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < v.size() / 3; ++i) sum -= g.segment<3>(3 * i);
  return sum;
}

Wind wind_of(const Vec3& velocity) {
  Wind wind;
  wind.velocity = velocity;
  return wind;
}

Simulation falling_sheet(const char* integrator, const Wind& wind) {
  ModelBuilder builder;
  const TriangleMesh sheet = grid_sheet(0.5, 0.5, 4, 4);
  MembraneMaterial m;
  m.areal_density = 0.1;
  const BodyRange body = builder.add_membrane("sheet", sheet, m);
  CHECK(body.count == 25);
  builder.set_wind(wind, {{sheet.triangles, false}});
  return {builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {integrator, "cholesky", {1e-8, 60}, 0}};
}

}  // namespace

TEST_CASE("wind presses on a held plate by half of density times coefficient times speed squared") {
  const TriangleMesh plate = grid_sheet(0.5, 0.4, 5, 4);
  Eigen::VectorXd x = stacked(plate.vertices);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(x.size());
  Wind wind = wind_of(Vec3(0, -7, 0));
  const auto across = make_wind(wind, {{plate.triangles, false}});
  across->begin_step({x, still, x, 0, 0.01});
  CHECK((force_on(*across, still) - Vec3(0, -0.5 * 1.2 * 1.2 * 49 * 0.2, 0)).norm() < 1e-12);
  // Tilted by a: pressure by the normal part of the speed, along the normal.
  const double a = 0.6;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(a, Vec3::UnitX()).toRotationMatrix();
  for (Eigen::Index i = 0; i < x.size() / 3; ++i) x.segment<3>(3 * i) = R * Vec3(x.segment<3>(3 * i));
  across->begin_step({x, still, x, 0, 0.01});
  const double pressure = 0.5 * 1.2 * 1.2 * std::pow(7 * std::cos(a), 2);
  CHECK((force_on(*across, still) + pressure * 0.2 * (R * Vec3::UnitY())).norm() < 1e-12);
  // Friction pulls along.
  wind.velocity = R * Vec3(3, 0, 0);
  wind.friction = 0.05;
  const auto along = make_wind(wind, {{plate.triangles, false}});
  along->begin_step({x, still, x, 0, 0.01});
  CHECK((force_on(*along, still) - 0.5 * 1.2 * 0.05 * 9 * 0.2 * (R * Vec3::UnitX())).norm() < 1e-12);
}

TEST_CASE("the drag of a closed body is that of its shadow") {
  const TetMesh cube = block_of_tets(Vec3(0.4, 0.3, 0.2), 2, 2, 2);
  const Eigen::VectorXd x = stacked(cube.vertices), still = Eigen::VectorXd::Zero(x.size());
  const auto term = make_wind(wind_of(Vec3(5, 0, 0)), {{boundary_triangles(cube), true}});
  term->begin_step({x, still, x, 0, 0.01});
  CHECK((force_on(*term, still) - Vec3(0.5 * 1.2 * 1.2 * 25 * 0.3 * 0.2, 0, 0)).norm() < 1e-12);
}

TEST_CASE("what moves with the wind feels none of it") {
  const TriangleMesh sheet = grid_sheet(1, 1, 3, 3);
  const Eigen::VectorXd x = stacked(sheet.vertices);
  Wind wind = wind_of(Vec3(3, -2, 1));
  wind.friction = 0.1;
  Eigen::VectorXd v(x.size());
  for (Eigen::Index i = 0; i < v.size() / 3; ++i) v.segment<3>(3 * i) = wind.velocity;
  const auto pressure = make_wind(wind, {{sheet.triangles, false}});
  const auto drag = make_wind_drag(wind, Eigen::VectorXd::Ones(16), 2);
  for (EnergyTerm* term : {pressure.get(), drag.get()}) {
    term->begin_step({x, v, x, 0, 0.01});
    Eigen::VectorXd g = Eigen::VectorXd::Zero(x.size());
    term->add_gradient(v, g);
    CHECK(g.norm() < 1e-14);  // rounding of the mean of three velocities, squared
    CHECK(term->value(v) < 1e-14);
  }
}

TEST_CASE("a sheet falls at the speed at which its drag carries its weight") {
  // v = sqrt(2 m g / (rho c A)); reached like tanh(g t / v), here beyond 1e-9 after 3 s.
  const double expected = std::sqrt(2 * 0.1 * 9.81 / (1.2 * 1.2));
  for (const char* integrator : {"implicit-euler", "symplectic-euler"}) {
    CAPTURE(integrator);
    Simulation s = falling_sheet(integrator, Wind());
    const double h = 1.0 / 400;
    for (int i = 0; i < 1200; ++i) REQUIRE(s.step(h).converged);
    for (int i = 0; i < 25; ++i) {
      CHECK(s.state().v(3 * i + 1) == doctest::Approx(-expected).scale(0).epsilon(1e-6));
      CHECK(std::abs(s.state().v(3 * i)) < 1e-6);
    }
  }
}

TEST_CASE("a falling sheet approaches that speed like a hyperbolic tangent, with the order of the method") {
  const double limit = std::sqrt(2 * 0.1 * 9.81 / (1.2 * 1.2));
  const auto error = [&](double h) {
    Simulation s = falling_sheet("implicit-euler", Wind());
    double worst = 0;
    for (int i = 1; i * h <= 0.25 + 1e-9; ++i) {
      REQUIRE(s.step(h).converged);
      worst = std::max(worst, std::abs(s.state().v(1) + limit * std::tanh(9.81 * i * h / limit)));
    }
    return worst;
  };
  const double order = std::log2(error(1.0 / 400) / error(1.0 / 800));
  CHECK(order == doctest::Approx(1).scale(0).epsilon(0.1));
}

TEST_CASE("wind on a turning sheet keeps the order of every method: lagged area and normal cost none") {
  // A slack sheet that spins in a wind which is strong enough to press on the same side all the time.
  const auto end_of = [](const char* integrator, int steps) {
    ModelBuilder builder;
    const TriangleMesh sheet = grid_sheet(0.5, 0.5, 2, 2);
    MembraneMaterial m;
    m.young = 500;
    m.areal_density = 0.3;
    const BodyRange body = builder.add_membrane("sheet", sheet, m);
    builder.set_velocity(body, Vec3::Zero(), Vec3(1, 0.5, 1.5));
    Wind wind = wind_of(Vec3(1, 6, 0.5));
    wind.friction = 0.2;
    builder.set_wind(wind, {{sheet.triangles, false}});
    Damping damping;
    damping.drag = 0.5;
    Simulation s(builder.finish(Vec3::Zero(), damping, {}, {}), {integrator, "cholesky", {1e-12, 60}, 0});
    for (int i = 0; i < steps; ++i) REQUIRE(s.step(0.2 / steps).converged);
    Eigen::VectorXd both(2 * s.state().x.size());
    both << s.state().x, s.state().v;
    return both;
  };
  const Eigen::VectorXd exact = end_of("rk4", 4000);
  const std::pair<const char*, int> kOrders[] = {{"implicit-euler", 1},
                                                 {"symplectic-euler", 1},
                                                 {"newmark", 2},
                                                 {"implicit-midpoint", 2},
                                                 {"bdf2", 2},
                                                 {"heun", 2},
                                                 {"rk4", 4}};
  for (const auto& [integrator, order] : kOrders) {
    CAPTURE(integrator);
    const int steps = order == 4 ? 60 : order == 2 ? 200 : 800;
    const double coarse = (end_of(integrator, steps) - exact).norm(),
                 fine = (end_of(integrator, 2 * steps) - exact).norm();
    MESSAGE(std::string(integrator) << ": order " << std::log2(coarse / fine));
    CHECK(std::abs(std::log2(coarse / fine) - order) < 0.1);
  }
}

TEST_CASE("the energy that wind puts in and drag takes out balances kinetic energy and weight") {
  // Implicit Euler loses 1/2 |v' - v|_M^2 a step by itself, first order in h: the balance closes to that.
  const auto imbalance = [&](double h) {
    Wind wind = wind_of(Vec3(0, 4, 0));  // blows it upwards
    Simulation s = falling_sheet("implicit-euler", wind);
    const Energies start = s.energies();
    for (int i = 0; i * h < 0.2; ++i) REQUIRE(s.step(h).converged);
    const Energies end = s.energies();
    CHECK(end.dissipated < 0);  // the wind drives
    return std::abs(end.kinetic + end.gravity + end.elastic + end.dissipated - start.gravity) / end.kinetic;
  };
  const double coarse = imbalance(1.0 / 400), fine = imbalance(1.0 / 800);
  CHECK(fine < 0.02);
  CHECK(coarse / fine == doctest::Approx(2).scale(0).epsilon(0.1));
}

TEST_CASE("drag is relative to the wind: a free body ends up carried along") {
  ModelBuilder builder;
  const TetMesh cube = block_of_tets(Vec3(0.2, 0.2, 0.2), 1, 1, 1);
  builder.add_solid("cube", cube, {"stable-neo-hookean", 1e4, 0.3, 1000});
  builder.set_wind(wind_of(Vec3(2, 1, -1)), {});
  Damping damping;
  damping.drag = 2;
  Simulation s(builder.finish(Vec3::Zero(), damping, {}, {}), {"implicit-euler", "cholesky", {1e-10, 60}, 0});
  const double h = 0.01;
  for (int i = 0; i < 100; ++i) REQUIRE(s.step(h).converged);
  // Implicit Euler's own decay: (w - v) shrinks by 1/(1 + gamma h) a step.
  const double left = std::pow(1 + 2 * h, -100);
  CHECK((Vec3(s.state().v.segment<3>(0)) - (1 - left) * Vec3(2, 1, -1)).norm() < 1e-8);
}

TEST_CASE("gusts have their mean, their bound and their seed, and travel with the wind") {
  Wind wind = wind_of(Vec3(6, 0, 2));
  wind.gusts = 0.4;
  wind.gust_period = 2;
  const WindField field(wind);
  const double speed = wind.velocity.norm();
  Vec3 mean = Vec3::Zero();
  double largest = 0;
  const int n = 40000;
  for (int i = 0; i < n; ++i) {
    const Vec3 gust = field.velocity(0.01 * i, Vec3::Zero()) - wind.velocity;
    mean += gust / n;
    largest = std::max(largest, gust.cwiseAbs().maxCoeff());
  }
  // 400 s of sines of at most 2 s: each leaves at most its amplitude times period / (pi duration).
  CHECK(mean.norm() < std::sqrt(3.0) * 0.4 * speed * 2 / (3.14 * 400));
  CHECK(largest < std::sqrt(3.0) * 0.4 * speed);
  CHECK(largest > 0.5 * 0.4 * speed);
  const Vec3 downstream = wind.velocity * 0.3;
  CHECK((field.velocity(1.0, Vec3(1, 2, 3)) - field.velocity(1.3, Vec3(1, 2, 3) + downstream)).norm() < 1e-12);
  wind.seed = 1;
  CHECK((WindField(wind).velocity(0, Vec3::Zero()) - field.velocity(0, Vec3::Zero())).norm() > 1e-3);
}
