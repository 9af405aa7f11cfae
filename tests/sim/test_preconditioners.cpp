// Preconditioners as operators, and what they save.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "sim/incomplete_cholesky.h"
#include "sim/multigrid_preconditioner.h"
#include "tests/sim/linear_systems.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

long iterations(const System& s, const LinearSettings& settings, double tolerance) {
  const auto solver = make_linear_solver(settings);
  solver->analyse(s.A);
  solver->factorize(s.A);
  Eigen::VectorXd x;
  const std::vector<double> targets = {tolerance * s.b.norm()};
  const LinearReport report = solver->solve(s.b, s.targets(targets), x);
  REQUIRE_MESSAGE(report.ok, report.reason);
  return report.iterations;
}

long cg_iterations(const System& s, std::string_view preconditioner) {
  LinearSettings settings("cg");
  settings.preconditioner = preconditioner;
  return iterations(s, settings, 1e-8);
}

}  // namespace

TEST_CASE("every preconditioner is a symmetric positive definite operator") {
  for (double young : {1e4, 1e7}) {
    const System s = real_system(6, young);  // 637 vertices: three levels
    for (const MethodInfo& info : preconditioners()) {
      CAPTURE(info.name);
      CAPTURE(young);
      const auto P = make_preconditioner(info.name);
      P->analyse(s.A);
      REQUIRE(P->factorize(s.A, s.targets({})).empty());
      for (unsigned seed = 1; seed <= 4; ++seed) {
        const Eigen::VectorXd r1 = random_vector(s.b.size(), 1, seed), r2 = random_vector(s.b.size(), 1, seed + 10);
        Eigen::VectorXd z1, z2, sum;
        P->apply(r1, z1);
        P->apply(r2, z2);
        CHECK(r1.dot(z1) > 0);
        CHECK(r2.dot(z2) > 0);
        // Products of a few hundred rounded operations on vectors of this size.
        CHECK(std::abs(z1.dot(r2) - r1.dot(z2)) < 1e-12 * std::sqrt(r1.dot(z1) * r2.dot(z2)));
        P->apply(r1 + 2 * r2, sum);
        CHECK((sum - z1 - 2 * z2).norm() < 1e-12 * (z1.norm() + 2 * z2.norm()));
      }
    }
  }
}

TEST_CASE("the eigenvalues of P^-1 A of multigrid are at most 1, and not far below") {
  const System s = real_system(4, 1e6);
  const Eigen::MatrixXd A = dense(s.A);
  MultigridPreconditioner P;
  REQUIRE(P.factorize(s.A, s.targets({})).empty());
  REQUIRE(P.level_rows().size() > 1);
  // L^T P^-1 L with A = L L^T has the eigenvalues of P^-1 A.
  const Eigen::MatrixXd L = A.llt().matrixL();
  Eigen::MatrixXd B(A.rows(), A.cols());
  Eigen::VectorXd z;
  for (Eigen::Index c = 0; c < A.cols(); ++c) {
    P.apply(L.col(c), z);
    B.col(c) = L.transpose() * z;
  }
  const Eigen::VectorXd lambda =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (B + B.transpose())).eigenvalues();
  MESSAGE("eigenvalues from " << lambda(0) << " to " << lambda(lambda.size() - 1));
  // I - P^-1 A = S* (coarse projection) S with the adjoint S*: positive semi-definite in the energy product.
  CHECK(lambda(0) > 0);
  CHECK(lambda(lambda.size() - 1) <= 1 + 1e-10);
}

TEST_CASE("better preconditioners take fewer iterations of conjugate gradients") {
  for (double young : {1e5, 1e7}) {
    const System s = real_system({21, 9, 9}, young, 1.0 / 60);
    const long none = cg_iterations(s, "none"), jacobi = cg_iterations(s, "jacobi"),
               block = cg_iterations(s, "block-jacobi"), incomplete = cg_iterations(s, "incomplete-cholesky"),
               multigrid = cg_iterations(s, "multigrid");
    MESSAGE("10,206 tets, Young " << young << ": none " << none << ", jacobi " << jacobi << ", block-jacobi " << block
                                  << ", incomplete-cholesky " << incomplete << ", multigrid " << multigrid);
    CHECK(jacobi < none);
    CHECK(block <= jacobi);
    CHECK(incomplete < block);
    CHECK(multigrid < incomplete);
  }
}

TEST_CASE("multigrid takes nearly as many iterations on fine meshes as on coarse ones") {
  // Stiff, so that the masses do not help: the condition number grows as the square of the number of cells.
  std::vector<long> cg, alone, plain;
  for (int cells : {4, 8, 16}) {
    const System s = real_system({2 * cells, cells, cells}, 1e8, 1.0 / 60);
    cg.push_back(cg_iterations(s, "multigrid"));
    alone.push_back(iterations(s, "multigrid", 1e-8));
    plain.push_back(cg_iterations(s, "block-jacobi"));
    MESSAGE(s.A.rows() << " vertices: cg with multigrid " << cg.back() << ", multigrid " << alone.back()
                       << ", cg with block-jacobi " << plain.back());
  }
  // Each size has 8 times the unknowns of the one before; block-jacobi needs about twice the iterations.
  for (size_t k = 1; k < cg.size(); ++k) {
    CHECK(cg[k] < 1.5 * static_cast<double>(cg[k - 1]));
    CHECK(static_cast<double>(plain[k]) > 1.5 * static_cast<double>(plain[k - 1]));
  }
}

TEST_CASE("two bodies of very different stiffness are no harder for multigrid than the stiffer alone") {
  const auto both = [](double soft, double stiff) {
    TetMesh block = block_of_tets(Vec3(0.5, 0.5, 0.5), 8, 8, 8);
    ModelBuilder builder;
    builder.add_solid("soft", block, {"stable-neo-hookean", soft, 0.4, 1000});
    for (Vec3& v : block.vertices) v.x() += 1;
    builder.add_solid("stiff", block, {"stable-neo-hookean", stiff, 0.4, 1000});
    System s{builder.finish(Vec3::Zero(), {}, {}, {}), {}, {}, {}, {}};
    Pins pins(s.model);
    IncrementalPotential phi(s.model, pins, terms_of(s.model, {}));
    s.x = s.model.x0;
    phi.stage().y_tilde = s.x;
    phi.stage().b = Eigen::VectorXd::Zero(s.x.size());
    phi.stage().a = 60;
    phi.stage().beta = 1.0 / 3600;
    StepReport report;
    phi.hessian(s.x, Definiteness::kClamped, s.A, report);
    s.held = phi.held();
    s.b = random_vector(s.x.size(), 1, 5);
    return s;
  };
  const auto run = [](const System& s) {
    LinearSettings settings("cg");
    settings.preconditioner = "multigrid";
    const auto solver = make_linear_solver(settings);
    solver->analyse(s.A);
    solver->factorize(s.A);
    Eigen::VectorXd x;
    const int half = 3 * s.model.bodies[0].count;
    const std::vector<double> targets = {1e-8 * s.b.head(half).norm(), 1e-8 * s.b.tail(half).norm()};
    const LinearReport report = solver->solve(s.b, s.targets(targets), x);
    REQUIRE_MESSAGE(report.ok, report.reason);
    return report.iterations;
  };
  const long mixed = run(both(1e4, 1e8)), stiff = run(both(1e8, 1e8));
  MESSAGE("Young 1e4 and 1e8: " << mixed << " iterations; 1e8 twice: " << stiff);
  CHECK(mixed <= 1.5 * static_cast<double>(stiff));
}

TEST_CASE("incomplete Cholesky equals A on its pattern where no pivot fails, and shifts where one does") {
  System s = real_system(3, 1e4);
  IncompleteCholesky P;
  REQUIRE(P.factorize(s.A, {}).empty());
  CHECK(P.shift() == 0);
  // P^-1 dense, hence P.
  Eigen::MatrixXd inverse(s.b.size(), s.b.size());
  Eigen::VectorXd z;
  for (Eigen::Index c = 0; c < s.b.size(); ++c) {
    P.apply(Eigen::VectorXd::Unit(s.b.size(), c), z);
    inverse.col(c) = z;
  }
  const Eigen::MatrixXd product = inverse.llt().solve(Eigen::MatrixXd::Identity(s.b.size(), s.b.size()));
  double worst = 0, largest = 0;
  for (int i = 0; i < s.A.rows(); ++i)
    for (int k = s.A.row_start[static_cast<size_t>(i)]; k < s.A.row_start[static_cast<size_t>(i) + 1]; ++k) {
      const auto block = s.A.block(k);
      worst = std::max(worst, (product.block<3, 3>(3 * i, 3 * s.A.column[static_cast<size_t>(k)]) - block).norm());
      largest = std::max(largest, block.norm());
    }
  CHECK(worst < 1e-11 * largest);  // rounding of the two dense inversions; condition below 1e3

  // Kershaw's matrix (1978): positive definite, but IC(0) meets a negative pivot. Here times I3.
  const double kershaw[4][4] = {{3, -2, 0, 2}, {-2, 3, -2, 0}, {0, -2, 3, -2}, {2, 0, -2, 3}};
  BlockMatrix K;
  K.row_start = {0};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (kershaw[i][j] == 0) continue;
      if (i == j) K.diagonal.push_back(static_cast<int>(K.column.size()));
      K.column.push_back(j);
      for (int e = 0; e < 9; ++e) K.values.push_back(e % 4 == 0 ? kershaw[i][j] : 0);
    }
    K.row_start.push_back(static_cast<int>(K.column.size()));
  }
  K.values.push_back(0);  // room at the end
  IncompleteCholesky Q;
  REQUIRE(Q.factorize(K, {}).empty());
  MESSAGE("Kershaw's matrix: shift " << Q.shift());
  CHECK(Q.shift() > 0);
  const Eigen::VectorXd r = random_vector(12, 1, 3);
  Q.apply(r, z);
  CHECK(r.dot(z) > 0);
}
