// Contact must not make energy.
#include <doctest/doctest.h>

#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

using namespace softreel::sim;

namespace {

const Vec3 kGravity(0, -9.81, 0);

double total(const Energies& e) { return e.kinetic + e.elastic + e.gravity + e.contact; }

}  // namespace

TEST_CASE("a sheet dropped with an explicit method lands without gaining energy, at any step") {
  for (int substeps : {20, 100, 300}) {
    TriangleMesh sheet = grid_sheet(0.4, 0.4, 4, 4);
    for (Vec3& v : sheet.vertices) v.y() += 0.2;
    ModelBuilder builder;
    builder.add_mass_spring("sheet", sheet, grid_springs(sheet, 4, 4, {20, 10, 0}), 0.3, 0);
    Simulation s(builder.finish(kGravity, {}, {Collider{}}, {2e-3, 1e-3, 0, kExplicitHardness}),
                 {"symplectic-euler", "auto", {}, 0});
    const double before = total(s.energies());
    double largest = 0;
    for (int i = 0; i < 15 * substeps; ++i) {
      REQUIRE(s.step(1.0 / (30 * substeps)).converged);
      largest = std::max(largest, total(s.energies()));
    }
    CAPTURE(substeps);
    // Symplectic Euler's energy wavers by a relative h omega/2 of what is in the contact: half of it at its stiffest.
    CHECK(largest < 1.5 * before);
    CHECK(s.state().x.cwiseAbs().maxCoeff() < 0.5);
  }
}

TEST_CASE("a sliding block brakes alike whether it starts in touch with the plane or just off it") {
  double slid[2] = {0, 0};
  for (int k = 0; k < 2; ++k) {
    TetMesh block = block_of_tets(Vec3(0.2, 0.2, 0.2), 3, 3, 3);
    for (Vec3& v : block.vertices) v.y() += k == 0 ? 0.1 : 0.102;
    ModelBuilder builder;
    const BodyRange body = builder.add_solid("block", block, {"stable-neo-hookean", 1e6, 0.3, 1000});
    builder.set_velocity(body, Vec3(1.5, 0, 0), Vec3::Zero());
    Collider plane;
    plane.friction = 0.3;
    Simulation s(builder.finish(kGravity, {}, {plane}, {}), {"implicit-euler", "auto", {1e-4, 60}, 6});
    double highest = 0;
    for (int i = 0; i < 120; ++i) {
      REQUIRE(s.step(1.0 / 120).converged);
      for (int v = 0; v < s.model().vertices(); ++v) highest = std::max(highest, s.state().x(3 * v + 1));
    }
    for (int v = 0; v < s.model().vertices(); ++v)
      slid[k] += (s.state().x(3 * v) - s.model().x0(3 * v)) / s.model().vertices();
    CHECK(highest < 0.23);  // no tripping: mu < 1 cannot tip a cube
  }
  // Pushed out of an overlap of d_hat within a step, the block flies for some 2 d_hat/h/g = 0.05 s, in which nothing
  // rubs on average more or less than its weight would.
  CHECK(slid[0] == doctest::Approx(slid[1]).scale(0).epsilon(0.1));
}

TEST_CASE("friction takes energy, never gives any, on a moving belt too") {
  TetMesh block = block_of_tets(Vec3(0.1, 0.1, 0.1), 2, 2, 2);
  for (Vec3& v : block.vertices) v.y() += 0.052;
  ModelBuilder builder;
  builder.add_solid("block", block, {"stable-neo-hookean", 1e6, 0.3, 1000});
  Collider belt;
  belt.friction = 0.5;
  belt.motion = Motion({{0, {0, 0, 0}, {0, 0, 0}}, {2, {4, 0, 0}, {0, 0, 0}}}, {0, 0, 0});
  Simulation s(builder.finish(kGravity, {}, {belt}, {}), {"implicit-euler", "auto", {}, 6});
  double last = 0;
  for (int i = 0; i < 240; ++i) {
    REQUIRE(s.step(1.0 / 240).converged);
    CHECK(s.energies().dissipated >= last);
    last = s.energies().dissipated;
  }
  // A block of mass m brought to the belt's speed v loses m v^2/2 in slipping.
  CHECK(last == doctest::Approx(0.5 * s.model().masses.sum() * 4).scale(0).epsilon(0.1));
}
