// Stiff, fast, large and badly matched: every step has to converge or to say that it did not.
#include <cstdio>

#include "tests/stress/bodies.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

constexpr double kLeft = -0.4999, kRight = 0.4999;

struct Bar {
  TetMesh mesh;
  Model model;
};

/// 1 m x 0.2 m x 0.2 m along x, held on the left and driven on the right.
Bar driven_bar(const SolidMaterial& material, int cells, const Motion& motion) {
  Bar bar{block_of_tets(Vec3(1, 0.2, 0.2), 5 * cells, cells, cells), {}};
  ModelBuilder builder;
  builder.add_solid("bar", bar.mesh, material);
  builder.add_pin(pin_where(bar.mesh.vertices, [](const Vec3& p) { return p.x() < kLeft; }));
  Pin driven = pin_where(bar.mesh.vertices, [](const Vec3& p) { return p.x() > kRight; });
  driven.motion = motion;
  builder.add_pin(std::move(driven));
  bar.model = builder.finish(Vec3::Zero(), {}, {}, {});
  return bar;
}

Motion turning(double degrees_per_second, double seconds) {
  return Motion({{0, {0, 0, 0}, {0, 0, 0}}, {seconds, {0, 0, 0}, {degrees_per_second * seconds, 0, 0}}}, {0.5, 0, 0});
}

}  // namespace

TEST_CASE("a rubber block, nu = 0.49, is stretched to five times its length in 16 increments") {
  for (const char* material : {"stable-neo-hookean", "corotated-det"}) {
    const int increments = 16;
    const Motion pull({{0, {0, 0, 0}, {0, 0, 0}}, {1, {4, 0, 0}, {0, 0, 0}}}, {0.5, 0, 0});
    Bar bar = driven_bar({material, 1e6, 0.49, 1000}, 3, pull);
    Simulation s(std::move(bar.model), {"static", "cholesky", {1e-6, 200}, 0});
    long iterations = 0;
    for (int i = 0; i < increments; ++i) {
      const StepReport r = s.step(1.0 / increments);
      REQUIRE_MESSAGE(r.converged, r.reason);
      iterations += r.newton_iterations;
    }
    const double rest = volume(bar.mesh, s.model().x0);
    std::printf("stretched fivefold at nu 0.49, %s: %ld iterations in %d increments, volume %+.1f %%\n", material,
                iterations, increments, 100 * (volume(bar.mesh, s.state().x) / rest - 1));
    CHECK(inverted(bar.mesh, s.state().x) == 0);
  }
}

TEST_CASE("a bar of Young 1e9 twisted at 270 degrees a second for 4 s: every step converges, nothing inverts") {
  Bar bar = driven_bar({"stable-neo-hookean", 1e9, 0.3, 1000}, 2, turning(270, 4));
  Simulation s(std::move(bar.model), {"implicit-euler", "cholesky", {}, 0});
  long iterations = 0;
  int most_inverted = 0;
  for (int i = 0; i < 480; ++i) {
    const StepReport r = s.step(1.0 / 120);
    REQUIRE_MESSAGE(r.converged, "step ", i, ": ", r.reason);
    iterations += r.newton_iterations;
    most_inverted = std::max(most_inverted, inverted(bar.mesh, s.state().x));
  }
  std::printf("twisted three times round at Young 1e9: %.1f iterations a step, most inverted tets %d\n",
              static_cast<double>(iterations) / 480, most_inverted);
  CHECK(most_inverted == 0);
}

TEST_CASE("steps from 0.002 s to 2 s on a twisting bar stay finite, and each lowers its objective") {
  for (const double h : {0.002, 0.02, 0.2, 2.0}) {
    Bar bar = driven_bar({"stable-neo-hookean", 1e6, 0.4, 1000}, 2, turning(45, 4));
    Simulation s(std::move(bar.model), {"implicit-euler", "cholesky", {}, 6});
    const auto objective = [&](const State& before, const Eigen::VectorXd& y) {
      double phi = 0;
      for (int i = 0; i < s.model().vertices(); ++i)
        phi += 0.5 * s.model().masses(i) * (y - before.x - h * before.v).segment<3>(3 * i).squaredNorm();
      for (const auto& term : s.model().potentials) phi += h * h * term->value(y);
      return phi;
    };
    const int steps = static_cast<int>(std::min(100.0, std::round(4 / h)));
    long iterations = 0, retries = 0;
    for (int i = 0; i < steps; ++i) {
      const State before = s.state();
      const StepReport r = s.step(h);
      REQUIRE_MESSAGE(r.converged, r.reason);
      REQUIRE(s.state().x.allFinite());
      iterations += r.newton_iterations;
      retries += r.retries;
      if (r.steps > 1) continue;  // taken in parts, each with an objective of its own
      // Where the solve started: in free motion, with what is held where it belongs at the end.
      Eigen::VectorXd start = before.x + h * before.v;
      const Pins pins(s.model());
      pins.place(before.t + h, start);
      CHECK(objective(before, s.state().x) < objective(before, start));
    }
    std::printf("twisting bar, h = %.3f s: %.1f iterations a step, %ld retried\n", h,
                static_cast<double>(iterations) / steps, retries);
  }
}

TEST_CASE("Young from 1e2 to 1e9 at default settings: the tip is where an exact solve puts it") {
  const TetMesh mesh = block_of_tets(Vec3(0.5, 0.1, 0.1), 10, 3, 3);
  const auto tip = [&](double young, bool exactly) {
    ModelBuilder builder;
    builder.add_solid("cantilever", mesh, {"stable-neo-hookean", young, 0.4, 1000});
    builder.add_pin(pin_where(mesh.vertices, [](const Vec3& p) { return p.x() < -0.2499; }));
    SimulationSettings settings;  // the defaults
    settings.minimizer.linear_tolerance = 1e-4;
    if (exactly) {
      settings.linear_solver = "cholesky";
      settings.minimizer.tolerance = 1e-10;
    }
    Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), settings);
    must_step(s, 1.0 / 120, 60);
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < mesh.vertices.size(); ++i)
      if (mesh.vertices[i].x() > 0.2499) {
        sum += s.state().x(3 * static_cast<int>(i) + 1) - mesh.vertices[i].y();
        ++count;
      }
    return sum / count;
  };
  for (double young = 1e2; young < 2e9; young *= 10) {
    const double at_default = tip(young, false), exactly = tip(young, true);
    std::printf("Young %.0e: tip %+.4e m, exactly %+.4e m, off by %.3f %%\n", young, at_default, exactly,
                100 * std::abs(at_default / exactly - 1));
    CHECK(at_default == doctest::Approx(exactly).scale(0).epsilon(0.01));
  }
}

TEST_CASE("neighbours with Young 1e4 and 1e8 and a mass ratio of 1e6, tied together") {
  // A light soft block hangs on a heavy stiff one, which hangs from the ceiling.
  for (const char* linear : {"cholesky", "cg"}) {
    TetMesh upper = block_of_tets(Vec3(0.4, 0.2, 0.4), 4, 2, 4), lower = upper;
    for (Vec3& v : upper.vertices) v.y() += 0.2;
    ModelBuilder builder;
    const BodyRange heavy = builder.add_solid("heavy", upper, {"stable-neo-hookean", 1e8, 0.3, 1e5});
    const BodyRange light = builder.add_solid("light", lower, {"stable-neo-hookean", 1e4, 0.3, 0.1});
    builder.add_pin(pin_where(upper.vertices, [](const Vec3& p) { return p.y() > 0.2999; }));
    std::vector<int> rim;  // of the lower block, from 0
    for (size_t i = 0; i < lower.vertices.size(); ++i)
      if (lower.vertices[i].y() > 0.0999) rim.push_back(static_cast<int>(i));
    AttachSettings touching;
    touching.near = 1e-3;
    builder.add_ties(
        find_ties({light.first, &lower.vertices, boundary_triangles(lower)}, rim,
                  {heavy.first, &upper.vertices, boundary_triangles(upper)}, touching, builder.stiffness()),
        0);
    Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {"implicit-euler", linear, {}, 0});
    long iterations = 0;
    for (int i = 0; i < 120; ++i) {
      const StepReport r = s.step(1.0 / 120);
      REQUIRE_MESSAGE(r.converged, "step ", i, " with ", linear, ": ", r.reason);
      iterations += r.newton_iterations;
    }
    double gap = 0;
    for (size_t i = 0; i < lower.vertices.size(); ++i)
      for (size_t k = 0; k < upper.vertices.size(); ++k)
        if ((lower.vertices[i] - upper.vertices[k]).norm() < 1e-9)
          gap = std::max(gap, (s.state().x.segment<3>(3 * (light.first + static_cast<int>(i))) -
                               s.state().x.segment<3>(3 * (heavy.first + static_cast<int>(k))))
                                  .norm());
    std::printf("tied, Young 1e4 to 1e8, masses 1 to 1e6, %s: %.1f iterations a step, gap %.1e m\n", linear,
                static_cast<double>(iterations) / 120, gap);
    CHECK(gap < 1e-3);
  }
}

TEST_CASE("degenerate elements: slivers, flat tetrahedra, springs without length") {
  // A sliver of height 1e-6 among whole tetrahedra: stiff, but a step is a step.
  TetMesh mesh = block_of_tets(Vec3(1, 0.2, 0.2), 5, 1, 1);
  const int top = static_cast<int>(mesh.vertices.size());
  const Tet& t = mesh.tets[0];
  const auto p = [&](size_t a) { return mesh.vertices[static_cast<size_t>(t[a])]; };
  const Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
  mesh.vertices.push_back((p(0) + p(1) + p(2)) / 3 - 1e-6 * (normal.dot(p(3) - p(0)) > 0 ? 1 : -1) * normal);
  Tet sliver{t[0], t[2], t[1], top};
  mesh.tets.push_back(sliver);
  ModelBuilder builder;
  builder.add_solid("bar", mesh, {"stable-neo-hookean", 1e5, 0.4, 1000});
  builder.add_pin(pin_where(mesh.vertices, [](const Vec3& q) { return q.x() < kLeft; }));
  Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {"implicit-euler", "auto", {}, 6});
  long iterations = 0;
  for (int i = 0; i < 60; ++i) {
    const StepReport r = s.step(1.0 / 60);
    REQUIRE_MESSAGE(r.converged, r.reason);
    iterations += r.newton_iterations;
  }
  std::printf("sliver of height 1e-6: %.1f iterations a step\n", static_cast<double>(iterations) / 60);
  CHECK(s.state().x.allFinite());

  CHECK_THROWS_WITH_AS(
      [] {
        TetMesh flat = block_of_tets(Vec3(1, 1, 1), 1, 1, 1);
        for (Vec3& v : flat.vertices) v.y() = 0;
        ModelBuilder().add_solid("flat", flat, {});
      }(),
      doctest::Contains("positive rest volume"), std::invalid_argument);

  // A spring whose ends coincide pulls nowhere, and stays finite.
  TriangleMesh pair;
  pair.vertices = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)};
  ModelBuilder springs;
  springs.add_mass_spring("springs", pair, {{0, 1, 100, 0.0}, {1, 2, 100, 1.0}}, 1, 0.1);
  springs.add_pin({{0}, {true, true, true}, {}});
  Model model = springs.finish(Vec3::Zero(), {}, {}, {});
  model.masses.setConstant(0.1);
  model.v0(7) = 1;
  Simulation swing(std::move(model), {"implicit-euler", "cholesky", {}, 6});
  must_step(swing, 1.0 / 60, 120);
  CHECK(swing.state().x.allFinite());
}

TEST_CASE("a 100 x 100 cloth of stiff fabric hangs from two corners at steps of 1/30 s") {
  const TriangleMesh sheet = grid_sheet(1, 1, 100, 100);
  ModelBuilder builder;
  builder.add_membrane("fabric", sheet, {"stvk", 1e7, 0.3, 5e-4, 1e-4, BendingModel::kAuto, 0.15});
  builder.add_pin(pin_where(sheet.vertices, [](const Vec3& p) { return p.z() < -0.4999 && std::abs(p.x()) > 0.4999; }));
  Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {"implicit-euler", "auto", {}, 6});
  long iterations = 0, retries = 0;
  for (int i = 0; i < 30; ++i) {
    const StepReport r = s.step(1.0 / 30);
    REQUIRE_MESSAGE(r.converged, r.reason);
    iterations += r.newton_iterations;
    retries += r.retries;
  }
  double longest = 0;  // of an edge, relative to rest
  for (const Triangle& t : sheet.triangles)
    for (size_t a = 0; a < 3; ++a) {
      const int i = t[a], j = t[(a + 1) % 3];
      const double rest = (s.model().x0.segment<3>(3 * i) - s.model().x0.segment<3>(3 * j)).norm();
      longest = std::max(longest, (s.state().x.segment<3>(3 * i) - s.state().x.segment<3>(3 * j)).norm() / rest);
    }
  std::printf("stiff 100 x 100 cloth at 1/30 s: %.1f iterations a step, %ld retried, longest edge %.3f of rest\n",
              iterations / 30.0, retries, longest);
  CHECK(s.state().x.allFinite());
  CHECK(total_energy(s) < 0);  // it fell, and gained nothing from nowhere
}
