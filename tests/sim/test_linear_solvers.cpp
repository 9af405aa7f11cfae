#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <string>
#include <utility>

#include "sim/auto_solver.h"
#include "sim/parallel.h"
#include "sim/simulation.h"
#include "tests/sim/linear_systems.h"

using namespace softreel::sim;
using namespace softreel::tests;

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

namespace {

/// What a solver says of A x = b when it has to reach |r| <= `target`.
LinearReport solve(const System& s, const LinearSettings& settings, double target, Eigen::VectorXd& x) {
  const auto solver = make_linear_solver(settings);
  solver->analyse(s.A);
  solver->factorize(s.A);
  const std::vector<double> targets = {target};
  return solver->solve(s.b, s.targets(targets), x);
}

/// Every solver, with every preconditioner that it takes.
std::vector<LinearSettings> all_settings() {
  std::vector<LinearSettings> all;
  for (const MethodInfo& method : linear_solvers()) {
    LinearSettings settings(method.name);
    if (settings.method == "cg" || settings.method == "gmres" || settings.method == "steepest-descent") {
      for (const MethodInfo& preconditioner : preconditioners()) {
        settings.preconditioner = preconditioner.name;
        all.push_back(settings);
      }
    } else {
      all.push_back(settings);
    }
  }
  return all;
}

}  // namespace

TEST_CASE(
    "on a step of a body of 10,206 tetrahedra every linear solver meets its tolerance, but Jacobi, which diverges") {
  const System s = real_system({21, 9, 9}, 1e5, 1.0 / 60);
  const double target = 1e-8 * s.b.norm();
  Eigen::VectorXd reference, x;
  REQUIRE(solve(s, "cholesky", target, reference).ok);
  for (const LinearSettings& settings : all_settings()) {
    CAPTURE(settings.method);
    CAPTURE(settings.preconditioner);
    const LinearReport report = solve(s, settings, target, x);
    if (settings.method == "jacobi") {
      CHECK_FALSE(report.ok);
      CHECK(report.reason.find("spectral radius") != std::string::npos);
      CHECK(report.rate > 1.3);  // 1.3 to 2.4 on tetrahedra at h = 1/60
      CHECK(report.rate < 2.4);
      CHECK(report.iterations < 100);  // told early
      continue;
    }
    REQUIRE_MESSAGE(report.ok, report.reason);
    // The error is A^-1 r, its norm at most |r| / smallest eigenvalue; for both solutions. The projection onto rigid
    // modes at the end lowers the energy of the error, which the same bound holds for.
    CHECK((x - reference).norm() <= 2 * target / s.smallest_eigenvalue());
  }
}

TEST_CASE("a stiff system is solved by every linear solver whose condition holds, or refused as too slow") {
  const System s = real_system(4, 1e7);
  const Eigen::VectorXd reference = dense(s.A).llt().solve(s.b);
  const std::vector<double> targets = {1e-10 * s.b.norm()};
  for (const LinearSettings& settings : all_settings()) {
    CAPTURE(settings.method);
    CAPTURE(settings.preconditioner);
    Eigen::VectorXd x, Ax;
    const auto solver = make_linear_solver(settings);
    solver->analyse(s.A);
    solver->factorize(s.A);
    // Without positions, hence without the projection onto rigid modes, which may raise the residual again.
    const LinearReport report = solver->solve(s.b, {s.model.bodies, targets, nullptr, nullptr}, x);
    // Rates of the order of the condition number, and of its square root.
    const bool slow = settings.method == "gauss-seidel" || settings.method == "sor" ||
                      (settings.method == "steepest-descent" && settings.preconditioner != "multigrid");
    if (settings.method == "jacobi") {
      CHECK(report.reason.find("spectral radius") != std::string::npos);
      continue;
    }
    if (slow && !report.ok) {
      CHECK_MESSAGE(report.reason.find("shrinks by a factor") != std::string::npos, report.reason);
      continue;
    }
    REQUIRE_MESSAGE(report.ok, report.reason);
    s.A.multiply(x, Ax);
    CHECK((s.b - Ax).norm() <= 2 * targets[0]);
    // The error is at most the residual times the condition number, here below 1e6.
    CHECK((x - reference).norm() < 1e-4 * reference.norm());
  }
}

TEST_CASE(
    "a matrix that is not positive definite is solved by lu, ldlt and gmres, and refused with a reason by the others") {
  System s = real_system(2, 1e5);
  for (double& v : s.A.values) v = -v;
  for (const LinearSettings& settings : all_settings()) {
    CAPTURE(settings.method);
    CAPTURE(settings.preconditioner);
    Eigen::VectorXd x, Ax;
    const LinearReport report = solve(s, settings, 1e-8, x);
    const bool definite_preconditioner =
        settings.preconditioner == "incomplete-cholesky" || settings.preconditioner == "multigrid";
    if (settings.method == "lu" || settings.method == "ldlt" ||
        (settings.method == "gmres" && !definite_preconditioner)) {
      REQUIRE_MESSAGE(report.ok, report.reason);
      s.A.multiply(x, Ax);
      CHECK((s.b - Ax).norm() <= 1e-8 * s.b.norm());
    } else {
      CHECK_FALSE(report.ok);
      CHECK(report.reason.find("positive definite") != std::string::npos);
    }
  }
}

TEST_CASE("an indefinite matrix with a positive diagonal is found out by every solver that needs a definite one") {
  System s = real_system(2, 1e5);
  // A - c (e_v e_w^T + e_w e_v^T): indefinite once c exceeds both diagonal entries, here of two neighbours.
  const auto v = static_cast<size_t>(s.A.rows()) / 2;
  for (int k = s.A.row_start[v]; k < s.A.row_start[v + 1]; ++k) {
    const int w = s.A.column[static_cast<size_t>(k)];
    if (w <= static_cast<int>(v)) continue;
    const double c =
        3 * std::max(s.A.block(s.A.diagonal[v])(0, 0), s.A.block(s.A.diagonal[static_cast<size_t>(w)])(0, 0));
    s.A.block(k)(0, 0) -= c;
    for (int l = s.A.row_start[static_cast<size_t>(w)]; l < s.A.row_start[static_cast<size_t>(w) + 1]; ++l)
      if (s.A.column[static_cast<size_t>(l)] == static_cast<int>(v)) s.A.block(l)(0, 0) -= c;
    break;
  }
  REQUIRE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(s.A)).eigenvalues()(0) < 0);
  for (const LinearSettings& settings : all_settings()) {
    CAPTURE(settings.method);
    CAPTURE(settings.preconditioner);
    Eigen::VectorXd x, Ax;
    const LinearReport report = solve(s, settings, 1e-8, x);
    const bool any = settings.method == "lu" || settings.method == "ldlt" || settings.method == "gmres";
    if (!any) CHECK_FALSE(report.ok);
    if (report.ok) {
      s.A.multiply(x, Ax);
      CHECK((s.b - Ax).norm() <= 1e-7 * s.b.norm());
    } else {
      CHECK_FALSE(report.reason.empty());
      CHECK(report.iterations < 10000);
    }
  }
}

TEST_CASE("a singular matrix, and what is not finite, are refused with a reason") {
  Eigen::VectorXd x;
  for (const auto& [kind, expected] :
       {std::pair{"matrix", "matrix is not finite"}, {"b", "right-hand side is not finite"}}) {
    System s = real_system(2, 1e5);
    if (std::string(kind) == "matrix")
      s.A.block(s.A.diagonal[s.A.diagonal.size() / 2])(1, 1) = std::numeric_limits<double>::quiet_NaN();
    else
      s.b(10) = std::numeric_limits<double>::infinity();
    for (const LinearSettings& settings : all_settings()) {
      CAPTURE(settings.method);
      CAPTURE(settings.preconditioner);
      const LinearReport report = solve(s, settings, 1e-8, x);
      CHECK_FALSE(report.ok);
      CHECK_MESSAGE(report.reason.find(expected) != std::string::npos, report.reason);
    }
  }
  System s = real_system(2, 1e5);
  // The same equations twice: rows and columns of vertex 5 become those of a vertex that nothing acts on.
  for (int i = 0; i < s.A.rows(); ++i)
    for (int k = s.A.row_start[static_cast<size_t>(i)]; k < s.A.row_start[static_cast<size_t>(i) + 1]; ++k)
      if (i == 5 || s.A.column[static_cast<size_t>(k)] == 5) s.A.block(k).setZero();
  for (const char* method : {"cholesky", "ldlt", "lu", "jacobi", "gauss-seidel", "sor", "multigrid"}) {
    CAPTURE(method);
    const LinearReport report = solve(s, method, 1e-8, x);
    CHECK_FALSE(report.ok);
    CHECK_MESSAGE((report.reason.find("singular") != std::string::npos ||
                   report.reason.find("positive definite") != std::string::npos),
                  report.reason);
  }
}

TEST_CASE("direct solvers refuse a matrix that is singular up to rounding, though no pivot is zero") {
  System s = real_system({6, 3, 3}, 1e5, 1.0, 0.0);
  // The stiffness alone, at rest: it does not feel the turn about the axis through the two held vertices.
  for (int i = 2; i < s.A.rows(); ++i)
    s.A.block(s.A.diagonal[static_cast<size_t>(i)]).diagonal().array() -= s.model.masses(i);
  for (const char* method : {"cholesky", "ldlt", "lu"}) {
    CAPTURE(method);
    Eigen::VectorXd x;
    const LinearReport report = solve(s, method, 1e-8, x);
    CHECK_FALSE(report.ok);
    CHECK_MESSAGE((report.reason == "the matrix is singular to working precision" ||
                   (method == std::string("cholesky") && report.reason == "the matrix is not positive definite")),
                  report.reason);
  }
}

TEST_CASE("settings out of range are refused") {
  for (double omega : {0.0, 2.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    LinearSettings settings("sor");
    settings.omega = omega;
    CHECK_THROWS_AS(make_linear_solver(settings), std::invalid_argument);
  }
  LinearSettings settings("gmres");
  settings.restart = 0;
  CHECK_THROWS_AS(make_linear_solver(settings), std::invalid_argument);
  CHECK_THROWS_WITH(make_linear_solver("cgs"), doctest::Contains("unknown linear solver 'cgs'"));
  settings = "cg";
  settings.preconditioner = "ilu";
  CHECK_THROWS_WITH(make_linear_solver(settings), doctest::Contains("unknown preconditioner 'ilu'"));
}

TEST_CASE("every linear solver gives the same bits with one and two threads, and with symbolic work done before") {
  const System s = real_system({12, 9, 9}, 1e5, 1.0 / 60);  // 1300 vertices: long enough loops to be split
  for (const LinearSettings& settings : all_settings()) {
    CAPTURE(settings.method);
    CAPTURE(settings.preconditioner);
    Eigen::VectorXd one, two, again;
    const std::vector<double> targets = {1e-6 * s.b.norm()};
    set_threads(1);
    const LinearReport first = solve(s, settings, targets[0], one);
    set_threads(2);
    const LinearReport second = solve(s, settings, targets[0], two);
    CHECK(first.ok == second.ok);
    CHECK(first.iterations == second.iterations);
    CHECK(one == two);
    // The same pattern with other values in between.
    System other = real_system({12, 9, 9}, 2e6, 1.0 / 60);
    const auto solver = make_linear_solver(settings);
    solver->analyse(other.A);
    if (settings.method != "auto") {  // which remembers what it found
      solver->factorize(other.A);
      solver->solve(other.b, other.targets(targets), again);
    }
    solver->factorize(s.A);
    solver->solve(s.b, s.targets(targets), again);
    CHECK(one == again);
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

TEST_CASE("conjugate gradients in single precision end within the targets of the matrix in double precision") {
  for (const double young : {1e5, 1e9}) {
    const System s = real_system(8, young);  // 1377 vertices
    ConjugateGradientSolver solver;
    solver.factorize(s.A);
    for (const double relative : {1e-1, 1e-4, 1.1e-5, 1e-8}) {  // the last one in double precision from the start
      CAPTURE(young);
      CAPTURE(relative);
      const std::vector<double> wanted{relative * s.b.norm()};
      LinearTargets targets = s.targets(wanted);
      targets.positions = nullptr;  // without the projection at the end, which has a residual of its own
      Eigen::VectorXd x;
      const LinearReport report = solver.solve(s.b, targets, x);
      REQUIRE_MESSAGE(report.ok, report.reason);
      Eigen::VectorXd Ax;
      s.A.multiply(x, Ax);
      CHECK((s.b - Ax).norm() <= wanted[0] * (1 + 1e-6));
    }
  }
}

TEST_CASE("a matrix too ill-conditioned for single precision costs no more than the attempt") {
  // A slender bar in long steps: its condition is far beyond 1e7.
  const System s = real_system({100, 2, 2}, 1e9, 1.0 / 24);
  REQUIRE(s.A.rows() > 600);
  const std::vector<double> loose{1e-1 * s.b.norm()}, exact{1e-6 * s.b.norm()};  // the latter in double precision alone
  ConjugateGradientSolver solver;
  solver.factorize(s.A);
  Eigen::VectorXd x;
  const LinearReport in_double = solver.solve(s.b, s.targets(exact), x),
                     in_single = solver.solve(s.b, s.targets(loose), x);
  REQUIRE(in_double.ok);
  REQUIRE(in_single.ok);
  MESSAGE(in_double.iterations << " iterations to 1e-6 in double precision, " << in_single.iterations << " to 0.1");
  CHECK(in_single.iterations < in_double.iterations + 600);
}

TEST_CASE("a direct solve that follows iterations which cost too much is not for ever") {
  // A long bar: cheap to factorize, and far for iterations to go if it is stiff; near if it is soft.
  System stiff = real_system({60, 3, 3}, 1e9), soft = real_system({60, 3, 3}, 1e4);
  REQUIRE(stiff.A.column == soft.A.column);
  const std::unique_ptr<LinearSolver> solver = make_linear_solver("auto");
  solver->analyse(stiff.A);
  const auto solve = [&](System& s, double relative) {
    const std::vector<double> wanted{relative * s.b.norm()};
    Eigen::VectorXd x;
    solver->factorize(s.A);
    const LinearReport report = solver->solve(s.b, s.targets(wanted), x);
    REQUIRE(report.ok);
    return std::string(report.chosen);
  };
  for (int i = 0; i < 3; ++i) CHECK(solve(stiff, 1e-10) == "cholesky");
  int until_cg = 0;
  while (solve(soft, 1e-2) != "cg") REQUIRE(++until_cg < 10);
  CHECK(solve(soft, 1e-2) == "cg");
}

TEST_CASE("auto, restored after it was used for something else, does what a fresh one does") {
  System hard = real_system({60, 3, 3}, 1e9), easy = real_system({60, 3, 3}, 1e4);
  const std::unique_ptr<LinearSolver> fresh = make_linear_solver("auto"), used = make_linear_solver("auto");
  const auto solve = [](LinearSolver& solver, System& s, double relative, Eigen::VectorXd& x) {
    const std::vector<double> wanted{relative * s.b.norm()};
    solver.factorize(s.A);
    return solver.solve(s.b, s.targets(wanted), x);
  };
  Eigen::VectorXd x, y;
  fresh->analyse(easy.A);
  used->analyse(easy.A);
  const std::vector<double> memory = fresh->memory();
  solve(*used, hard, 1e-10, x);  // factorizes
  REQUIRE(used->memory() != memory);
  used->restore(memory);
  for (int i = 0; i < 3; ++i) {
    const LinearReport a = solve(*fresh, easy, 1e-3, x), b = solve(*used, easy, 1e-3, y);
    CHECK(a.chosen == b.chosen);
    CHECK(a.iterations == b.iterations);
    CHECK(x == y);
    CHECK(fresh->memory() == used->memory());
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
