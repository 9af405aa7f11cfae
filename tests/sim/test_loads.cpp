// Loads: their sums, their times, and the closed forms that they allow.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/grids.h"
#include "sim/load.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"
#include "tests/sim/derivatives.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

std::vector<Triangle> where(const std::vector<Triangle>& all, const std::vector<Vec3>& vertices, const auto& inside) {
  std::vector<Triangle> chosen;
  for (const Triangle& t : all)
    if (inside(vertices[static_cast<size_t>(t[0])]) && inside(vertices[static_cast<size_t>(t[1])]) &&
        inside(vertices[static_cast<size_t>(t[2])]))
      chosen.push_back(t);
  return chosen;
}

Pin roller(const std::vector<Vec3>& vertices, int axis, double at) {
  Pin pin;
  for (size_t i = 0; i < vertices.size(); ++i)
    if (std::abs(vertices[i](axis) - at) < 1e-12) pin.vertices.push_back(static_cast<int>(i));
  for (int a = 0; a < 3; ++a) pin.axes[a] = a == axis;
  return pin;
}

}  // namespace

TEST_CASE("nodal forces of a traction have the force and the torque of the traction over the area") {
  // A tilted rectangle of 0.6 m x 0.4 m around (1, 2, 3), irregularly cut: force t A, torque centre x t A.
  TriangleMesh sheet = grid_sheet(0.6, 0.4, 3, 5);
  for (Vec3& v : sheet.vertices)
    if (std::abs(v.x()) < 0.29 && std::abs(v.z()) < 0.19) v += Vec3(0.03 * std::sin(9 * v.z()), 0, 0.02 * v.x());
  const Eigen::Matrix3d R = euler_xyz({20, 30, 40});
  for (Vec3& v : sheet.vertices) v = R * v + Vec3(1, 2, 3);
  const Vec3 traction(10, -20, 5);
  const NodalForces f = share_traction(traction, sheet.triangles, stacked(sheet.vertices));
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (size_t i = 0; i < f.vertices.size(); ++i) {
    force += f.forces[i];
    torque += sheet.vertices[static_cast<size_t>(f.vertices[i])].cross(f.forces[i]);
  }
  const Vec3 expected = 0.6 * 0.4 * traction;
  CHECK((force - expected).norm() < 1e-12 * expected.norm());
  CHECK((torque - Vec3(1, 2, 3).cross(expected)).norm() < 1e-12 * 4 * expected.norm());
}

TEST_CASE("a force is shared by mass and adds up to its total") {
  const Eigen::VectorXd masses = Eigen::Vector4d(1, 2, 3, 4);
  const std::vector<int> vertices = {1, 3};
  const NodalForces f = share_force(Vec3(0, 6, 3), vertices, masses);
  CHECK((f.forces[0] - Vec3(0, 2, 1)).norm() < 1e-15);
  CHECK((f.forces[1] - Vec3(0, 4, 2)).norm() < 1e-15);
}

TEST_CASE("the mean of a load over a step is the integral of its course") {
  const LoadTimes times{0.2, 1.5, 0.5};
  for (double t = -0.3; t < 2; t += 0.07)
    for (double h : {0.01, 0.4, 3.0}) {
      double sum = 0;
      const int n = 20000;  // midpoint rule; the jump at `until` costs at most h/n
      for (int i = 0; i < n; ++i) sum += times.at(t + (i + 0.5) * h / n) / n;
      CHECK(times.mean(t, h) == doctest::Approx(sum).scale(1).epsilon(1.0 / n));
    }
  CHECK(LoadTimes{}.mean(0, 0.1) == 1);
}

TEST_CASE("a load gives a free body exactly its impulse, whenever it begins and ends") {
  for (const char* integrator : {"implicit-euler", "symplectic-euler"}) {
    CAPTURE(integrator);
    ModelBuilder builder;
    const TetMesh cube = block_of_tets(Vec3(0.2, 0.2, 0.2), 2, 2, 2);
    builder.add_solid("cube", cube, {"stable-neo-hookean", 1e4, 0.3, 1000});
    std::vector<int> all(cube.vertices.size());
    for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    builder.add_load(share_force(Vec3(3, -2, 1), all, builder.masses()), {0.0137, 0.1031, 0.05});
    Simulation s(builder.finish(Vec3::Zero(), {}, {}, {}), {integrator, "cholesky", {1e-10, 60}, 0});
    for (int i = 0; i < 60; ++i) REQUIRE(s.step(1.0 / 480).converged);
    Vec3 momentum = Vec3::Zero();
    for (int i = 0; i < s.model().vertices(); ++i) momentum += s.model().masses(i) * s.state().v.segment<3>(3 * i);
    // Half of the ramp counts. The tolerance is that of the solve.
    const Vec3 impulse = (0.1031 - 0.0137 - 0.025) * Vec3(3, -2, 1);
    CHECK((momentum - impulse).norm() < 1e-9 * impulse.norm());
  }
}

TEST_CASE("a traction on the end of a bar makes a uniform stress: every vertex moves by t x / E") {
  // Rollers on three sides leave the bar free to contract, so linear elements represent the exact solution: the error
  // is that of the solver, and what is left of the motion. Without rotation this material is linear in the stretches.
  const double young = 1e5, poisson = 0.3, traction = 500;
  const TetMesh bar = block_of_tets(Vec3(1, 0.4, 0.3), 5, 2, 2);
  ModelBuilder builder;
  builder.add_solid("bar", bar, {"corotated-volume", young, poisson, 10});
  builder.add_pin(roller(bar.vertices, 0, -0.5));
  builder.add_pin(roller(bar.vertices, 1, -0.2));
  builder.add_pin(roller(bar.vertices, 2, -0.15));
  const auto end = where(boundary_triangles(bar), bar.vertices, [](const Vec3& p) { return p.x() > 0.4999; });
  CHECK(end.size() == 8);
  builder.add_load(share_traction(Vec3(traction, 0, 0), end, builder.positions()), {});
  Simulation s(builder.finish(Vec3::Zero(), {}, {}, {}), {"implicit-euler", "cholesky", {1e-11, 60}, 0});
  for (int i = 0; i < 60; ++i) REQUIRE(s.step(1.0).converged);
  const double strain = traction / young;
  double worst = 0;
  for (size_t i = 0; i < bar.vertices.size(); ++i) {
    const Vec3& p = bar.vertices[i];
    const Vec3 expected(strain * (p.x() + 0.5), -poisson * strain * (p.y() + 0.2), -poisson * strain * (p.z() + 0.15));
    const Vec3 moved = s.state().x.segment<3>(3 * static_cast<Eigen::Index>(i)) - p;
    worst = std::max(worst, (moved - expected).norm());
  }
  CHECK(worst < 1e-9 * strain);
}
