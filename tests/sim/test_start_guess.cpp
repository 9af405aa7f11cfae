#include <doctest/doctest.h>

#include "sim/grids.h"
#include "sim/start_guess.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE("a guess meets motion whose acceleration changes evenly, with steps of any length") {
  const auto acceleration = [](double t) { return Eigen::Vector3d(2 - 3 * t, 5 * t, 1); };
  StartGuess guess;
  CHECK_FALSE(guess.any());
  Stage stage;
  stage.y_tilde = Eigen::Vector3d(0.1, -7, 0);
  double t = 0;
  for (const double h : {0.5, 0.25, 0.75, 0.125}) {
    t += h;
    stage.beta = h * h;
    const Eigen::Vector3d y = stage.y_tilde + stage.beta * acceleration(t);
    if (t > 1) {  // two steps are known
      Eigen::VectorXd found;
      guess.guess(stage, h, found);
      CHECK((found - y).norm() < 1e-6);  // single precision of accelerations near 10
    }
    guess.accept(stage, h, y);
  }
  StartGuess copy;
  std::vector<double> saved = guess.memory();
  saved.push_back(42);
  CHECK(copy.restore(saved, 3).size() == 1);
  CHECK(copy.memory() == guess.memory());
  CHECK_THROWS_AS(copy.restore(std::span(saved).first(2), 3), std::invalid_argument);
  CHECK_THROWS_AS(copy.restore(saved, 6), std::invalid_argument);  // of another model
  guess.forget();
  CHECK_FALSE(guess.any());
}

TEST_CASE(
    "a smooth swing takes fewer Newton iterations than a solve from the motion without forces, and ends the same") {
  const auto model = [] {
    ModelBuilder builder;
    const TetMesh mesh = block_of_tets(Vec3(1, 0.2, 0.2), 10, 2, 2);
    builder.add_solid("beam", mesh, {"stable-neo-hookean", 1e5, 0.3, 1000});
    builder.add_pin(pin_where(mesh.vertices, [](const Vec3& p) { return p.x() < -0.499; }));
    return builder.finish(Vec3(0, -9.81, 0), {}, {}, {});
  };
  SimulationSettings settings;
  settings.minimizer.tolerance = 1e-6;
  Simulation guessed(model(), settings), plain(model(), settings);
  StepReport with, without;
  for (int i = 0; i < 60; ++i) {
    with.add(guessed.step(1.0 / 120));
    // A simulation made anew from the state knows of no acceleration.
    Simulation fresh(model(), settings);
    const std::vector<double> memory = fresh.memory();
    fresh.restore(plain.state(), memory);
    without.add(fresh.step(1.0 / 120));
    plain.restore(fresh.state(), memory);
  }
  REQUIRE(with.converged);
  REQUIRE(without.converged);
  MESSAGE("Newton iterations of 60 steps: " << with.newton_iterations << " with, " << without.newton_iterations
                                            << " without");
  CHECK(with.newton_iterations < without.newton_iterations);
  // Each step leaves at most tolerance of its forces.
  const double way = (plain.state().x - plain.model().x0).norm();
  CHECK((guessed.state().x - plain.state().x).norm() < 60 * 1e-6 * way);
}
