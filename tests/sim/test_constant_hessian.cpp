// Where no Hessian ever changes, the matrix is worked out once for each length of step.
#include <doctest/doctest.h>

#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

using namespace softreel::sim;

namespace {

/// A beam of linear material, held at one end, under gravity and drag.
Model beam(const std::string& material) {
  ModelBuilder builder;
  const TetMesh block = block_of_tets(Vec3(1, 0.2, 0.2), 6, 2, 2);
  const BodyRange body = builder.add_solid("beam", block, {material, 1e5, 0.3, 1000});
  Pin pin;
  for (size_t i = 0; i < block.vertices.size(); ++i)
    if (block.vertices[i].x() < -0.49) pin.vertices.push_back(body.first + static_cast<int>(i));
  builder.add_pin(pin);
  return builder.finish(Vec3(0, -9.81, 0), {0.5, 0, 0}, {}, {});
}

constexpr double kStep = 1.0 / 120;

}  // namespace

TEST_CASE("a linear solid takes one iteration a step, and its matrix is assembled once for each length of step") {
  for (const char* integrator : {"implicit-euler", "newmark", "implicit-midpoint", "bdf2"})
    for (const char* linear : {"auto", "cholesky", "cg"}) {
      CAPTURE(integrator);
      CAPTURE(linear);
      SimulationSettings settings;
      settings.integrator = integrator;
      settings.linear_solver.method = linear;
      Simulation simulation(beam("linear"), settings);
      const auto assembled = [&](double h) {
        const StepReport report = simulation.step(h);
        CHECK(report.converged);
        CHECK(report.newton_iterations == 1);
        return report.seconds.assemble > 0;  // the clock of a stage that is not entered stays at 0 exactly
      };
      CHECK(assembled(kStep));
      // bdf2 takes its first step as implicit Euler does.
      if (std::string(integrator) == "bdf2") assembled(kStep);
      for (int step = 0; step < 5; ++step) CHECK_FALSE(assembled(kStep));
      CHECK(assembled(kStep / 2));
    }
}

TEST_CASE("a kept matrix gives the bits of one that is assembled anew") {
  SimulationSettings settings;
  settings.linear_solver.method = "cholesky";
  Simulation kept(beam("linear"), settings), from(beam("linear"), settings);
  for (int step = 0; step < 6; ++step) {
    Simulation anew(beam("linear"), settings);
    anew.restore(from.state(), from.memory());
    CHECK(kept.step(kStep).converged);
    CHECK(anew.step(kStep).converged);
    CHECK(kept.state().x == anew.state().x);
    CHECK(kept.state().v == anew.state().v);
    from.restore(anew.state(), anew.memory());
  }
}

TEST_CASE("other materials are assembled in every iteration") {
  Simulation simulation(beam("stable-neo-hookean"), {});
  for (int step = 0; step < 3; ++step) {
    const StepReport report = simulation.step(kStep);
    CHECK(report.newton_iterations >= 1);
    CHECK(report.seconds.assemble > 0);
  }
}
