// The worked example of sim/README.md, "A linear solver", built and measured as it stands there.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "tests/sim/linear_systems.h"
#include "tests/sim/richardson_solver.h"
#include "tests/sim/source_text.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE("the linear solver that the README adds is this one, to the letter") {
  const std::string code = source_text("tests/sim/richardson_solver.h");
  REQUIRE(code.size() > 1000);
  CHECK(source_text("sim/README.md").find(code) != std::string::npos);
}

TEST_CASE("the linear solver that the README adds solves, at the rate of its theory, and refuses what it cannot") {
  System s = real_system({4, 2, 2}, 2e4, 1.0 / 60);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(s.A)).eigenvalues();
  const double alpha = dense(s.A).cwiseAbs().rowwise().sum().maxCoeff();
  REQUIRE(alpha >= eigenvalues.maxCoeff());
  const double target = 1e-8 * s.b.norm();
  const std::vector<double> targets = {target};
  RichardsonSolver solver;
  solver.analyse(s.A);
  solver.factorize(s.A);
  Eigen::VectorXd x, Ax;
  const LinearReport report = solver.solve(s.b, s.targets(targets), x);
  REQUIRE_MESSAGE(report.ok, report.reason);
  s.A.multiply(x, Ax);
  CHECK((s.b - Ax).norm() <= 2 * target);  // the correction by rigid modes minimizes another norm
  // The factor from one iteration to the next rises towards the radius, and never beyond.
  const double radius = 1 - eigenvalues(0) / alpha;
  CHECK(report.rate <= radius * (1 + 1e-10));
  CHECK(report.rate > 1 - 2 * (1 - radius));

  for (const int k : s.A.diagonal) s.A.block(k).diagonal().array() -= 0.1 * eigenvalues.maxCoeff();
  solver.factorize(s.A);
  const LinearReport refused = solver.solve(s.b, s.targets(targets), x);
  CHECK_FALSE(refused.ok);
  CHECK(refused.indefinite);
}
