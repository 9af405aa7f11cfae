#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <string>

#include "sim/attachment.h"
#include "sim/bending.h"
#include "sim/collider_contact.h"
#include "sim/drag.h"
#include "sim/gravity.h"
#include "sim/grids.h"
#include "sim/load.h"
#include "sim/materials/lame.h"
#include "sim/membrane.h"
#include "sim/solid.h"
#include "sim/spring_damping.h"
#include "sim/springs.h"
#include "sim/stiffness_damping.h"
#include "sim/wind.h"
#include "tests/sim/derivatives.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

constexpr double kYoung = 1e4;

struct NamedState {
  std::string name;
  Eigen::VectorXd x;
};

/// Random, flat, inverted, and (if asked) collapsed states of a rest shape of size about 1.
std::vector<NamedState> states(const std::vector<Vec3>& rest, bool collapsed) {
  const Eigen::VectorXd x = stacked(rest);
  std::vector<NamedState> all;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    all.push_back({"slightly deformed", x + random_vector(x.size(), 0.05, seed)});
    all.push_back({"random", random_vector(x.size(), 1.0, 10 + seed)});
  }
  const auto mapped = [&](const Eigen::Matrix3d& A, unsigned seed, double noise) {
    Eigen::VectorXd y(x.size());
    for (Eigen::Index i = 0; i < x.size() / 3; ++i) y.segment<3>(3 * i) = A * x.segment<3>(3 * i);
    return Eigen::VectorXd(y + random_vector(x.size(), noise, seed));
  };
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  all.push_back({"rest", x});
  all.push_back({"turned", mapped(turn, 0, 0)});
  all.push_back({"flat", mapped(turn * Eigen::Vector3d(1.1, 0, 0.9).asDiagonal(), 0, 0)});
  all.push_back({"inverted", mapped(turn * Eigen::Vector3d(1.1, -0.8, 0.9).asDiagonal(), 20, 0.01)});
  if (collapsed) {
    all.push_back({"collapsed to a line", mapped(turn * Eigen::Vector3d(1.3, 0, 0).asDiagonal(), 0, 0)});
    all.push_back({"collapsed to a point", Eigen::VectorXd::Constant(x.size(), 0.3)});
  }
  return all;
}

void check_derivatives(const EnergyTerm& term, const std::vector<NamedState>& all, double stiffness_scale) {
  for (const NamedState& s : all) {
    INFO(s.name);
    const DerivativeErrors e = derivative_errors(term, s.x, stiffness_scale, stiffness_scale, 1.0);
    CHECK(e.gradient < 1e-6);
    CHECK(e.hessian < 1e-6);
    CHECK(e.most_negative > -1e-10);
    CHECK(e.clamping_of_convex < 1e-12);
  }
}

}  // namespace

TEST_CASE("the derivatives of every solid material agree with central differences") {
  const TetMesh mesh = block_of_tets(Vec3(1, 1.2, 0.8), 1, 1, 1);
  for (const MethodInfo& m : solid_materials()) {
    for (double poisson : {0.0, 0.3, 0.45, 0.49}) {
      CAPTURE(m.name);
      CAPTURE(poisson);
      const auto term = make_solid(m.name, kYoung, poisson, mesh, 0);
      check_derivatives(*term, states(mesh.vertices, solid_traits(m.name).smooth_when_collapsed),
                        solid_lame(kYoung, poisson).mu);
    }
  }
}

TEST_CASE("the derivatives of every membrane material agree with central differences") {
  const TriangleMesh mesh = grid_sheet(1, 1.2, 2, 2);
  for (const MethodInfo& m : membrane_materials()) {
    for (double poisson : {0.0, 0.3, 0.45, 0.49}) {
      CAPTURE(m.name);
      CAPTURE(poisson);
      const auto term = make_membrane(m.name, kYoung, poisson, 1.0, mesh, 0);
      check_derivatives(*term, states(mesh.vertices, membrane_traits(m.name).smooth_when_collapsed),
                        surface_lame(kYoung, poisson).mu);
    }
  }
}

TEST_CASE("the derivatives of both bending energies agree with central differences") {
  TriangleMesh mesh = grid_sheet(1, 1, 2, 2);
  check_derivatives(*make_quadratic_bending(mesh, 100, 0), states(mesh.vertices, true), 100);
  // A curved rest shape, and states whose triangles keep an area: a fold by exactly half a turn has no derivative.
  for (Vec3& v : mesh.vertices) v.y() = 0.4 * v.x() * v.x() - 0.2 * v.z() * v.x();
  const auto shell = make_discrete_shell_bending(mesh, 100, 0);
  std::vector<NamedState> near;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Eigen::VectorXd x = stacked(mesh.vertices);
    near.push_back({"deformed", x + random_vector(x.size(), 0.1, seed)});
  }
  check_derivatives(*shell, near, 100);
}

TEST_CASE("the derivatives of springs and of their damping agree with central differences") {
  const TriangleMesh mesh = grid_sheet(1, 1, 3, 3);
  const std::vector<Spring> springs = grid_springs(mesh, 3, 3, {100, 50, 10});
  CHECK(springs.size() == 24 + 18 + 16);
  check_derivatives(*make_springs(springs), states(mesh.vertices, false), 100);
  const auto damping = make_spring_damping(springs, 3.0);
  const Eigen::VectorXd x = stacked(mesh.vertices), v = random_vector(x.size(), 1, 5);
  damping->begin_step({x, v, x, 0, 0.01});
  check_derivatives(*damping, {{"random velocities", v}}, 3.0);
}

TEST_CASE("springs of zero length stay finite") {
  const auto term = make_springs({{0, 1, 100, 0.5}});
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(6);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(6);
  term->add_gradient(x, g);
  CHECK(g.norm() == 0);
  CHECK(term->value(x) == doctest::Approx(0.5 * 100 * 0.25));
  CHECK(dense_hessian(*term, x, Definiteness::kClamped).allFinite());
}

TEST_CASE("the derivatives of drag, stiffness damping and gravity agree with central differences") {
  const TetMesh mesh = block_of_tets(Vec3(1, 1, 1), 1, 1, 1);
  const Eigen::VectorXd x = stacked(mesh.vertices), v = random_vector(x.size(), 1, 3);
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(8, 1, 2);
  check_derivatives(*make_drag(masses, 0.7), {{"random velocities", v}}, 1);
  check_derivatives(*make_gravity(masses, Vec3(0.3, -9.81, 0.1)), {{"random", v}}, 1);
  const auto elastic = make_solid("stable-neo-hookean", kYoung, 0.3, mesh, 0);
  const auto damping = make_stiffness_damping(*elastic, 0.02);
  const Eigen::VectorXd predicted = x + 0.1 * v;
  damping->begin_step({x, v, predicted, 0, 0.1});
  check_derivatives(*damping, {{"random velocities", v}}, 0.02 * kYoung);
  // It is the clamped stiffness at the predicted positions.
  const Eigen::MatrixXd K = dense_hessian(*elastic, predicted, Definiteness::kClamped);
  CHECK(damping->value(v) == doctest::Approx(0.01 * v.dot(K * v)).scale(0).epsilon(1e-12));
}

TEST_CASE("the derivatives of contact and friction with every collider agree with central differences") {
  std::vector<Collider> colliders;
  const auto add = [&](ColliderShape shape, double friction) {
    Collider c;
    c.shape = shape;
    c.friction = friction;
    c.world_from_shape.linear() = euler_xyz({20, 30, 40});
    c.world_from_shape.translation() = Vec3(0.1, -0.2, 0.05);
    c.motion = Motion({{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.3, 0, 0}, {0, 90, 0}}}, {0, 0, 0});
    colliders.push_back(c);
  };
  add(PlaneShape{}, 0.4);
  add(SphereShape{0.5}, 0.3);
  add(BoxShape{{0.3, 0.4, 0.5}}, 0);
  add(CapsuleShape{0.3, 0.4}, 0.6);
  const int n = 40;
  const Eigen::VectorXd masses = Eigen::VectorXd::Constant(n, 0.1);
  ColliderContact contact(masses, colliders, {0.2, 0.05, 1e4});
  const auto friction = make_collider_friction(contact, 0.05);
  const Eigen::VectorXd x = random_vector(3 * n, 0.8, 7), v = random_vector(3 * n, 0.1, 8);
  const Eigen::VectorXd predicted = x + 0.01 * v;
  const StepContext context{x, v, predicted, 0.3, 0.01};
  contact.begin_step(context);
  friction->begin_step(context);
  CHECK(contact.report(x).active > n / 2);
  // Contact drops the (negative) curvature of the shape from its Hessian: only its gradient is exact.
  const DerivativeErrors e = derivative_errors(contact, x, 1e4 * 0.04, 1e4, 1.0);
  CHECK(e.gradient < 1e-6);
  CHECK(e.most_negative > -1e-10);
  const DerivativeErrors f = derivative_errors(*friction, v, 1, 1, 0.1);
  CHECK(f.gradient < 1e-6);
  CHECK(f.hessian < 1e-6);
  CHECK(f.most_negative > -1e-10);
}

TEST_CASE("the derivatives of loads and of wind agree with central differences") {
  const TriangleMesh sheet = grid_sheet(1, 1, 2, 2);
  const Eigen::VectorXd x = stacked(sheet.vertices) + random_vector(27, 0.1, 1), v = random_vector(27, 3, 2);
  const auto load = make_load({{2, 5}, {Vec3(1, 2, 3), Vec3(0, -1, 0)}}, {0.1, 5, 0.3});
  load->begin_step({x, v, x, 0.2, 0.01});
  check_derivatives(*load, {{"random", x}}, 1);
  Wind wind;
  wind.velocity = Vec3(1, 2, 0.5);
  wind.friction = 0.1;
  wind.gusts = 0.5;
  for (bool closed : {false, true}) {
    const auto pressure = make_wind(wind, {{sheet.triangles, closed}});
    pressure->begin_step({x, v, x, 0.2, 0.01});
    check_derivatives(*pressure, {{"random velocities", v}, {"at rest", Eigen::VectorXd::Zero(27)}}, 0.1);
  }
  const auto drag = make_wind_drag(wind, Eigen::VectorXd::LinSpaced(9, 1, 2), 0.7);
  drag->begin_step({x, v, x, 0.2, 0.01});
  check_derivatives(*drag, {{"random velocities", v}}, 1);
}

TEST_CASE("the derivatives of ties of every kind, and of their damping, agree with central differences") {
  const std::vector<Vec3> rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.2, 0.4}, {2, 0, 0}, {2, 0.4, 0.3}};
  const Vec3 inside(0.5, 0.3, 0.2), to_corners(rest[3].norm(), (rest[3] - rest[1]).norm(), (rest[3] - rest[2]).norm());
  const std::vector<std::vector<Tie>> kinds = {{{3, {0, 1, 2}, inside, 10, 0, Vec3::Zero()}},
                                               {{3, {0, 1, 2}, inside, 10, 0.4, to_corners}},
                                               {{4, {5, 5, 5}, Vec3(1, 0, 0), 10, 0, Vec3::Zero()}},
                                               {{4, {5, 5, 5}, Vec3(1, 0, 0), 10, 0.5, Vec3::Zero()}}};
  for (const std::vector<Tie>& ties : kinds) {
    CAPTURE(ties[0].vertex);
    CAPTURE(ties[0].length);
    const auto potential = make_ties(ties), damping = make_tie_damping(ties, 3.0);
    REQUIRE(potential.size() == 1);
    REQUIRE(damping.size() == 1);
    check_derivatives(*potential[0], states(rest, false), 10);
    const Eigen::VectorXd x = stacked(rest), v = random_vector(x.size(), 1, 5);
    damping[0]->begin_step({x, v, x, 0, 0.01});
    check_derivatives(*damping[0], {{"random velocities", v}}, 3);
  }
}

TEST_CASE("a sheet bent to a cylinder stores half its rigidity times curvature squared per area") {
  // Hinges of a fine, slightly bent grid: the error is of second order in the cell size over the radius.
  const double rigidity = 2e-3, radius = 10;
  const TriangleMesh flat = grid_sheet(1, 1, 40, 40);
  Eigen::VectorXd x = stacked(flat.vertices);
  for (Eigen::Index i = 0; i < x.size() / 3; ++i) {
    const double angle = x(3 * i) / radius;
    x(3 * i) = radius * std::sin(angle);
    x(3 * i + 1) = radius * (1 - std::cos(angle));
  }
  // Inner hinges only: 39 of 40 columns bend.
  const double expected = 0.5 * rigidity / (radius * radius) * 39.0 / 40.0;
  CHECK(make_quadratic_bending(flat, rigidity, 0)->value(x) == doctest::Approx(expected).scale(0).epsilon(1e-4));
  CHECK(make_discrete_shell_bending(flat, rigidity, 0)->value(x) == doctest::Approx(expected).scale(0).epsilon(1e-4));
}
