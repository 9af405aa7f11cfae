// Scalar fields: matrices of the elements, and the equation of Poisson.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include "tests/sim/fields.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE(
    "the stiffness of a field is symmetric, has zero row sums, no negative eigenvalue, and is exact for linear "
    "functions") {
  const TriangleMesh mesh = uneven_square(6);
  const ScalarMatrix K = assemble_stiffness(mesh);
  const Eigen::MatrixXd dense = K;
  const double norm = dense.norm();
  CHECK((dense - dense.transpose()).norm() <= 1e-14 * norm);
  CHECK(dense.rowwise().sum().norm() <= 1e-14 * norm);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
  CHECK(eigenvalues(0) >= -1e-13 * norm);
  CHECK(eigenvalues(1) > 1e-3 * norm / static_cast<double>(dense.rows()));  // only the constants are free
  // u = 2x - 3z: energy |grad u|^2 area = 13, and no residual at an inner vertex.
  const Eigen::VectorXd u = at_vertices(mesh, [](const Vec3& p) { return 2 * p.x() - 3 * p.z(); });
  CHECK(u.dot(dense * u) == doctest::Approx(13).scale(0).epsilon(1e-13));
  Eigen::VectorXd residual = dense * u;
  for (int v : boundary_vertices(mesh)) residual(v) = 0;
  CHECK(residual.norm() <= 1e-13 * norm);
}

TEST_CASE("the mass of a field sums to the area, the consistent one integrates products of linear functions exactly") {
  const TriangleMesh mesh = uneven_square(6);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(mesh.vertices.size()));
  const Eigen::VectorXd x = at_vertices(mesh, [](const Vec3& p) { return p.x(); });
  const ScalarMatrix lumped = assemble_mass(mesh, FieldMass::kLumped);
  const ScalarMatrix consistent = assemble_mass(mesh, FieldMass::kConsistent);
  CHECK(one.dot(lumped * one) == doctest::Approx(1).scale(0).epsilon(1e-13));
  CHECK(one.dot(consistent * one) == doctest::Approx(1).scale(0).epsilon(1e-13));
  CHECK((consistent * one - lumped * one).norm() <= 1e-15);
  CHECK(x.dot(consistent * x) == doctest::Approx(1.0 / 12).scale(0).epsilon(1e-13));
  CHECK(lumped.nonZeros() == one.size());
}

TEST_CASE("poisson reproduces linear functions to rounding on an uneven mesh") {
  FieldProblem p;
  p.mesh = uneven_square(9);
  p.fixed = {boundary_of(p.mesh, steady([](const Vec3& x) { return 1 + 2 * x.x() - 3 * x.z(); }))};
  const Field field(p, "");
  const Eigen::VectorXd exact = at_vertices(p.mesh, [](const Vec3& x) { return 1 + 2 * x.x() - 3 * x.z(); });
  CHECK((field.value() - exact).cwiseAbs().maxCoeff() <= 1e-12);
}

TEST_CASE("poisson on the unit square converges with order 2 in L2 and order 1 in H1") {
  for (const bool uneven : {false, true}) {
    CAPTURE(uneven);
    SpaceErrors coarse;
    for (int cells = 8; cells <= 64; cells *= 2) {
      FieldProblem p;
      p.mesh = uneven ? uneven_square(cells) : square(cells);
      p.source = steady([](const Vec3& x) { return 2 * kPi * kPi * mode(x); });
      p.fixed = {boundary_of(p.mesh, constant(0))};
      const Field field(p, "");
      const SpaceErrors fine = errors_against_mode(p.mesh, field.value());
      if (cells > 8) {
        MESSAGE(cells << " cells: L2 " << fine.l2 << " (order " << order_of(coarse.l2, fine.l2) << "), H1 " << fine.h1
                      << " (order " << order_of(coarse.h1, fine.h1) << ")");
      }
      if (cells > 16) {  // from the third mesh on
        CHECK(order_of(coarse.l2, fine.l2) == doctest::Approx(2).scale(0).epsilon(0.05));
        CHECK(order_of(coarse.h1, fine.h1) == doctest::Approx(1).scale(0).epsilon(0.1));
      }
      coarse = fine;
    }
  }
}

TEST_CASE("poisson without a fixed value is refused, also on one piece of two") {
  FieldProblem p;
  p.mesh = square(4);
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
  const auto n = static_cast<int>(p.mesh.vertices.size());
  TriangleMesh two = p.mesh;
  for (const Vec3& v : p.mesh.vertices) two.vertices.push_back(v + Vec3(5, 0, 0));
  for (const Triangle& t : p.mesh.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  p.mesh = two;
  p.fixed = {{{0}, constant(1)}};
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
  p.fixed.push_back({{n}, constant(2)});
  const Field field(p, "");
  CHECK(field.value()(n - 1) == doctest::Approx(1));
  CHECK(field.value()(2 * n - 1) == doctest::Approx(2));
}

TEST_CASE("a mesh with a flat triangle or a vertex of no triangle is refused") {
  FieldProblem p;
  p.mesh = square(2);
  p.mesh.vertices.emplace_back(3, 0, 0);
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
  p.mesh = square(2);
  p.mesh.triangles.push_back({0, 1, 2});  // on one line
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
}
