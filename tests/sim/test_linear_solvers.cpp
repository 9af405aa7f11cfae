#include <doctest/doctest.h>

#include <Eigen/Cholesky>

#include "sim/grids.h"
#include "sim/incremental_potential.h"
#include "sim/linear_solver.h"
#include "sim/model_builder.h"
#include "sim/parallel.h"
#include "sim/simulation.h"
#include "tests/sim/derivatives.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

struct System {
  Model model;
  BlockMatrix A;
  Eigen::VectorXd b;
};

/// One step's matrix of a deformed body with two held vertices, and a random right-hand side that is zero there.
System real_system(int cells, double young) {
  const TetMesh mesh = block_of_tets(Vec3(1, 0.5, 0.5), 2 * cells, cells, cells);
  ModelBuilder builder;
  builder.add_solid("block", mesh, {"stable-neo-hookean", young, 0.4, 1000});
  Pin pin;
  pin.vertices = {0, 1};
  builder.add_pin(std::move(pin));
  System s{builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {}, {}};
  Pins pins(s.model);
  IncrementalPotential phi(s.model, pins);
  const Eigen::VectorXd x = s.model.x0 + random_vector(s.model.x0.size(), 0.02 / cells, 4);
  phi.stage().y_tilde = x;
  phi.stage().b = Eigen::VectorXd::Zero(x.size());
  phi.stage().a = 120;
  phi.stage().beta = 1.0 / (120 * 120);
  StepReport report;
  phi.hessian(x, Definiteness::kClamped, s.A, report);
  s.b = random_vector(x.size(), 1, 5);
  pins.zero(s.b);
  return s;
}

Eigen::MatrixXd dense(const BlockMatrix& A) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(3 * A.rows(), 3 * A.rows());
  for (int i = 0; i < A.rows(); ++i)
    for (int k = A.row_start[static_cast<size_t>(i)]; k < A.row_start[static_cast<size_t>(i) + 1]; ++k)
      D.block<3, 3>(3 * i, 3 * A.column[static_cast<size_t>(k)]) = A.block(k);
  return D;
}

}  // namespace

TEST_CASE("the assembled matrix is symmetric, and equals the sum of its elements made dense") {
  const System s = real_system(2, 1e5);
  const Eigen::MatrixXd A = dense(s.A);
  CHECK((A - A.transpose()).norm() < 1e-15 * A.norm());  // rounding within diagonal blocks; the others are mirrored
  const Eigen::VectorXd x = s.model.x0 + random_vector(s.model.x0.size(), 0.01, 4);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(A.rows(), A.cols());
  for (const auto& term : s.model.potentials)
    expected += dense_hessian(*term, x, Definiteness::kClamped) / (120.0 * 120.0);
  for (int i = 0; i < s.model.vertices(); ++i)
    expected.block<3, 3>(3 * i, 3 * i).diagonal().array() += s.model.masses(i);
  expected.topRows(6).setZero();
  expected.leftCols(6).setZero();
  expected.topLeftCorner(6, 6).setIdentity();
  CHECK((A - expected).norm() < 1e-14 * expected.norm());
}

TEST_CASE("every linear solver meets its tolerance on a real system and agrees with a dense factorization") {
  for (double young : {1e4, 1e7}) {
    const System s = real_system(4, young);
    const Eigen::VectorXd reference = dense(s.A).llt().solve(s.b);
    const std::vector<double> targets = {1e-10 * s.b.norm()};
    for (const auto& [name, help, cost, source, order] : linear_solvers()) {
      CAPTURE(name);
      CAPTURE(young);
      const auto solver = make_linear_solver(name);
      solver->analyse(s.A);
      solver->factorize(s.A);
      Eigen::VectorXd x, Ax;
      const LinearReport report = solver->solve(s.b, {s.model.bodies, targets, nullptr, nullptr}, x);
      REQUIRE_MESSAGE(report.ok, report.reason);
      s.A.multiply(x, Ax);
      CHECK((s.b - Ax).norm() <= 2e-10 * s.b.norm());
      // The error is at most the residual times the condition number, here below 1e6 at Young 1e7.
      CHECK((x - reference).norm() < 1e-4 * reference.norm());
    }
  }
}

TEST_CASE("a matrix that is not positive definite is refused with a reason") {
  System s = real_system(2, 1e5);
  for (double& v : s.A.values) v = -v;
  const std::vector<double> targets = {1e-8};
  for (const auto& [name, help, cost, source, order] : linear_solvers()) {
    CAPTURE(name);
    const auto solver = make_linear_solver(name);
    solver->analyse(s.A);
    solver->factorize(s.A);
    Eigen::VectorXd x;
    const LinearReport report = solver->solve(s.b, {s.model.bodies, targets, nullptr, nullptr}, x);
    CHECK_FALSE(report.ok);
    CHECK(report.reason.find("positive definite") != std::string::npos);
  }
}

TEST_CASE("the rigid-mode projection never makes a solution worse in the norm of its energy") {
  const System s = real_system(3, 1e7);
  const Eigen::MatrixXd A = dense(s.A);
  const Eigen::VectorXd exact = A.llt().solve(s.b);
  std::vector<std::uint8_t> held(static_cast<size_t>(s.b.size()), 0);
  std::fill(held.begin(), held.begin() + 6, std::uint8_t{1});
  for (double tolerance : {0.5, 0.1, 1e-2, 1e-4}) {
    const std::vector<double> targets = {tolerance * s.b.norm()};
    const auto error = [&](const Eigen::VectorXd* positions) {
      ConjugateGradientSolver cg;
      cg.factorize(s.A);
      Eigen::VectorXd x;
      REQUIRE(cg.solve(s.b, {s.model.bodies, targets, positions, &held}, x).ok);
      CHECK(x.head(6).norm() == 0);
      return (x - exact).dot(A * (x - exact));
    };
    CHECK(error(&s.model.x0) <= error(nullptr) * (1 + 1e-12));
  }
}

TEST_CASE("the choice of auto is restored with its memory") {
  const System s = real_system(8, 1e5);
  AutoSolver first;
  first.analyse(s.A);
  first.factorize(s.A);
  Eigen::VectorXd x;
  const std::vector<double> targets = {1e-3 * s.b.norm()};
  const LinearTargets wanted{s.model.bodies, targets, nullptr, nullptr};
  REQUIRE(first.solve(s.b, wanted, x).ok);
  AutoSolver second;
  second.analyse(s.A);
  second.restore(first.memory());
  CHECK(second.memory() == first.memory());
  second.factorize(s.A);
  first.factorize(s.A);
  Eigen::VectorXd x1, x2;
  const LinearReport r1 = first.solve(s.b, wanted, x1), r2 = second.solve(s.b, wanted, x2);
  CHECK(r1.chosen == r2.chosen);
  CHECK(x1 == x2);
  CHECK(first.memory() == second.memory());
}

TEST_CASE("a simulation has the same bits with one, two and three threads, and after a resume") {
  const auto model = [] {
    TetMesh block = block_of_tets(Vec3(0.5, 0.3, 0.3), 10, 6, 6);
    for (Vec3& v : block.vertices) v.y() += 0.2;
    TriangleMesh sheet = grid_sheet(1, 1, 40, 40);
    for (Vec3& v : sheet.vertices) v.y() += 0.8;
    ModelBuilder builder;
    builder.add_solid("block", block, {"stable-neo-hookean", 2e4, 0.4, 1000});
    builder.add_membrane("sheet", sheet, {"stvk", 1e4, 0.3, 1e-3, 1e-5, BendingModel::kAuto, 0.2});
    Pin pin;
    pin.vertices = {block.vertices.size() > 0 ? static_cast<int>(block.vertices.size()) : 0};
    builder.add_pin(std::move(pin));
    Collider plane;
    plane.friction = 0.5;
    return builder.finish(Vec3(0, -9.81, 0), {0.1, 0, 1e-3}, {plane}, {});
  };
  const SimulationSettings settings;
  std::vector<Eigen::VectorXd> ends;
  State middle;
  std::vector<double> memory;
  for (int count : {1, 2, 3}) {
    set_threads(count);
    Simulation s(model(), settings);
    for (int i = 0; i < 16; ++i) {
      REQUIRE(s.step(1.0 / 60).converged);
      if (i == 7) {
        middle = s.state();
        memory = s.memory();
      }
    }
    ends.push_back(s.state().x);
  }
  CHECK(ends[0] == ends[1]);
  CHECK(ends[0] == ends[2]);
  set_threads(2);
  Simulation resumed(model(), settings);
  resumed.restore(middle, memory);
  for (int i = 8; i < 16; ++i) REQUIRE(resumed.step(1.0 / 60).converged);
  CHECK(resumed.state().x == ends[0]);
}
