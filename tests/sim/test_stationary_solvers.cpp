// Convergence rates of the simple iterations against the theory of the matrix at hand.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "tests/sim/linear_systems.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

/// Soft enough, in steps short enough, for Jacobi to converge: the masses carry the matrix.
System soft_system() { return real_system({4, 2, 2}, 2e4, 1.0 / 60); }

double radius(const Eigen::MatrixXd& G) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(G, false).eigenvalues().cwiseAbs().maxCoeff();
}

/// Of I - P^-1 A.
double theory(const Eigen::MatrixXd& A, const std::string& method, double omega) {
  Eigen::MatrixXd P = A.diagonal().asDiagonal();
  if (method != "jacobi") {
    P /= omega;
    P += Eigen::MatrixXd(A.triangularView<Eigen::StrictlyLower>());
  }
  return radius(Eigen::MatrixXd::Identity(A.rows(), A.cols()) - P.partialPivLu().solve(A));
}

/// The iterate after exactly k iterations, which a target of 0 does not end.
Eigen::VectorXd iterate(const System& s, LinearSettings settings, long k) {
  settings.max_iterations = k;
  const auto solver = make_linear_solver(settings);
  solver->analyse(s.A);
  solver->factorize(s.A);
  Eigen::VectorXd x;
  const std::vector<double> targets = {0.0};
  const LinearReport report = solver->solve(s.b, s.targets(targets), x);
  CHECK_FALSE(report.ok);
  CHECK(report.iterations == k);
  return x;
}

}  // namespace

TEST_CASE("jacobi, gauss-seidel and sor converge at the spectral radius of I - P^-1 A") {
  const System s = soft_system();
  const Eigen::MatrixXd A = dense(s.A);
  const Eigen::VectorXd exact = A.llt().solve(s.b);
  struct Case {
    std::string method;
    double omega;
  };
  for (const auto& [method, omega] :
       {Case{"jacobi", 1}, {"gauss-seidel", 1}, {"sor", 0.5}, {"sor", 1.3}, {"sor", 1.7}}) {
    CAPTURE(method);
    CAPTURE(omega);
    LinearSettings settings(method);
    settings.omega = omega;
    const double rho = theory(A, method, omega);
    REQUIRE(rho < 1);
    // |e_k| ~ C rho^k: over `span` sweeps, begun when the error is 1e-6, and what decays faster is gone, and ended at
    // 1e-12 of the first, far above rounding. Complex pairs of eigenvalues (sor) make the factor swing: over the span
    // that is a constant, below 2.
    const auto sweeps = [&](double reduction) {
      return std::max(4L, std::lround(std::log(reduction) / std::log(rho)));
    };
    const long first = sweeps(1e-6), last = sweeps(1e-12);
    const double measured =
        std::pow((iterate(s, settings, last) - exact).norm() / (iterate(s, settings, first) - exact).norm(),
                 1.0 / static_cast<double>(last - first));
    MESSAGE(method << " omega " << omega << ": radius " << rho << ", measured " << measured);
    CHECK(std::abs(std::log(measured) - std::log(rho)) * static_cast<double>(last - first) < std::log(4.0));
  }
}

TEST_CASE("where Jacobi diverges it says so with the spectral radius, and gauss-seidel and sor converge") {
  for (double young : {1e5, 1e7}) {
    const System s = real_system({4, 2, 2}, young, 1.0 / 60);
    const double rho = theory(dense(s.A), "jacobi", 1);
    REQUIRE(rho > 1);
    const auto jacobi = make_linear_solver("jacobi");
    jacobi->factorize(s.A);
    Eigen::VectorXd x;
    const std::vector<double> targets = {1e-8 * s.b.norm()};
    const LinearReport report = jacobi->solve(s.b, s.targets(targets), x);
    CHECK_FALSE(report.ok);
    CHECK(report.reason.find("spectral radius") != std::string::npos);
    MESSAGE("Young " << young << ": radius " << rho << ", after " << report.iterations << " sweeps: " << report.reason);
    // The factor rises to the radius; it is told once it rises by less than 1e-3 a sweep.
    CHECK(report.rate <= rho * (1 + 1e-9));
    CHECK(report.rate > 0.95 * rho);
    CHECK(report.iterations < 100);
    CHECK(theory(dense(s.A), "gauss-seidel", 1) < 1);
    CHECK(theory(dense(s.A), "sor", 1.5) < 1);
  }
}

TEST_CASE("steepest descent shrinks the energy norm of the error by (kappa - 1)/(kappa + 1) or more in every step") {
  const System s = real_system({4, 2, 2}, 1e5, 1.0 / 60);
  const Eigen::MatrixXd A = dense(s.A);
  const Eigen::VectorXd exact = A.llt().solve(s.b);
  const auto energy = [&](const Eigen::VectorXd& x) { return std::sqrt((x - exact).dot(A * (x - exact))); };
  for (const std::string preconditioner : {"none", "jacobi"}) {
    LinearSettings settings("steepest-descent");
    settings.preconditioner = preconditioner;
    // kappa of P^-1 A, through the symmetric P^-1/2 A P^-1/2.
    Eigen::VectorXd root = Eigen::VectorXd::Ones(A.rows());
    if (settings.preconditioner == "jacobi") root = A.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::VectorXd lambda =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(root.asDiagonal() * A * root.asDiagonal()).eigenvalues();
    const double kappa = lambda(lambda.size() - 1) / lambda(0), bound = (kappa - 1) / (kappa + 1);
    double before = energy(Eigen::VectorXd::Zero(s.b.size())), slowest = 0;
    for (long k = 1; k <= 40; ++k) {  // far from rounding
      const double now = energy(iterate(s, settings, k));
      slowest = std::max(slowest, now / before);
      CHECK(now <= bound * before * (1 + 1e-10));
      before = now;
    }
    MESSAGE("preconditioner " << preconditioner << ": kappa " << kappa << ", bound " << bound << ", slowest step "
                              << slowest);
  }
}
