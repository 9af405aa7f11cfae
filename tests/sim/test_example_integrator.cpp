// The worked example of sim/README.md, "An integrator", built and measured as it stands there.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/sim/ralston.h"
#include "tests/sim/source_text.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

/// A hard spring with drag, x'' = -x - x^3 - v/5, driven: after two seconds.
Eigen::Vector2d end(ExplicitMethod& method, int steps) {
  const Acceleration acceleration{[](State& at, Eigen::VectorXd& a) {
                                    a = -at.x.array() - at.x.array().cube() - 0.2 * at.v.array() + std::sin(at.t);
                                  },
                                  true};
  State s{0, Eigen::VectorXd::Constant(1, 1), Eigen::VectorXd::Constant(1, 0.5)};
  for (int i = 0; i < steps; ++i) method.step(acceleration, 2.0 / steps, s);
  return {s.x(0), s.v(0)};
}

}  // namespace

TEST_CASE("the integrator that the README adds is this one, to the letter") {
  const std::string code = source_text("tests/sim/ralston.h");
  REQUIRE(code.size() > 500);
  CHECK(source_text("sim/README.md").find(code) != std::string::npos);
}

TEST_CASE("the integrator that the README adds has its order") {
  Rk4 reference_method;
  Ralston method;
  const Eigen::Vector2d reference = end(reference_method, 4000);
  const double coarse = (end(method, 200) - reference).norm(), fine = (end(method, 400) - reference).norm();
  CHECK(std::abs(std::log2(coarse / fine) - Ralston::kInfo.order) < 0.1);
}
