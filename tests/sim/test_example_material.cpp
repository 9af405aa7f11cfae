// The worked example of sim/README.md, "A material", built and measured as it stands there.
#include <doctest/doctest.h>

#include <Eigen/LU>

#include "sim/mesh.h"
#include "sim/simplex_kernel.h"
#include "tests/sim/derivatives.h"
#include "tests/sim/source_text.h"
#include "tests/sim/symmetric_dirichlet.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE("the material that the README adds is this one, to the letter") {
  const std::string code = source_text("tests/sim/symmetric_dirichlet.h");
  REQUIRE(code.size() > 1000);
  CHECK(source_text("sim/README.md").find(code) != std::string::npos);
}

TEST_CASE("the material that the README adds has the derivatives of its energy") {
  // Corner 0 at the origin, the others at the unit vectors: F's columns are the moved corners.
  SimplexKernel<SymmetricDirichlet, 3> kernel{SymmetricDirichlet({1, 0}), {{Eigen::Matrix3d::Identity(), 1.0 / 6}}};
  const ElementTerm<SimplexKernel<SymmetricDirichlet, 3>> term("example", EnergyKind::kElastic, {0, 1, 2, 3}, kernel);
  const Eigen::VectorXd rest = stacked({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  CHECK(term.value(rest) == 0);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const DerivativeErrors e = derivative_errors(term, rest + random_vector(12, 0.2, seed), 1, 1, 1);
    CHECK(e.gradient < 1e-6);
    CHECK(e.hessian < 1e-6);
    CHECK(e.most_negative > -1e-10);
    CHECK(e.clamping_of_convex < 1e-12);
  }
}
