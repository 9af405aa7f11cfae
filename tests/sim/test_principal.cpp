#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <limits>
#include <random>

#include "sim/principal.h"

using namespace softreel::sim;

namespace {

Eigen::Matrix3d random_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Matrix3d F;
  for (double& v : F.reshaped()) v = normal(random);
  return F;
}

void check_factors(const Eigen::Matrix3d& F) {
  const Principal<3> p = principal_stretches(F);
  const double scale = std::max(F.norm(), std::numeric_limits<double>::min());
  CHECK((p.U * p.sigma.asDiagonal() * p.V.transpose() - F).norm() < 1e-14 * scale);
  CHECK((p.U.transpose() * p.U - Eigen::Matrix3d::Identity()).norm() < 1e-13);
  CHECK((p.V.transpose() * p.V - Eigen::Matrix3d::Identity()).norm() < 1e-13);
  CHECK(p.U.determinant() == doctest::Approx(1));
  CHECK(p.V.determinant() == doctest::Approx(1));
  CHECK(p.sigma(0) >= p.sigma(1));
  CHECK(p.sigma(1) >= std::abs(p.sigma(2)) * (1 - 1e-12));
}

}  // namespace

TEST_CASE("principal stretches rebuild F with rotations, for random, flat, inverted and collapsed F") {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d F = random_matrix(random);
    check_factors(F);
    check_factors(1e-150 * F);
    check_factors(1e150 * F);
    const Eigen::Matrix3d Q = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    for (double strain : {0.0, 1e-12, 1e-8, 1e-4, 0.1})  // equal stretches, to rounding or nearly
      check_factors(Q * (Eigen::Matrix3d::Identity() + strain * F));
    check_factors(Q * Eigen::Vector3d(1.2, 0.7, 0).asDiagonal() * Q.transpose());
    check_factors(Q * Eigen::Vector3d(1.2, 0, 0).asDiagonal());
    check_factors(Q * Eigen::Vector3d(1, 1, -1).asDiagonal());
    check_factors(Q * Eigen::Vector3d(1, 1e-9, -1e-12).asDiagonal() * F.householderQr().householderQ());
    const Eigen::Vector3d expected = Eigen::JacobiSVD<Eigen::Matrix3d>(F).singularValues();
    CHECK((principal_stretches(F).sigma.cwiseAbs() - expected).norm() < 1e-13 * expected.norm());
  }
  check_factors(Eigen::Matrix3d::Zero());
  check_factors(Eigen::Matrix3d::Identity());
  check_factors(-Eigen::Matrix3d::Identity());
  check_factors(Eigen::Matrix3d::Constant(1));
}

TEST_CASE("principal stretches of a surface rebuild F with an orthonormal frame, for collapsed triangles too") {
  std::mt19937 random(2);
  const auto check = [](const Eigen::Matrix<double, 3, 2>& F) {
    const Principal<2> p = principal_stretches(F);
    CHECK((p.U.leftCols<2>() * p.sigma.asDiagonal() * p.V.transpose() - F).norm() <= 1e-14 * F.norm());
    CHECK((p.U.transpose() * p.U - Eigen::Matrix3d::Identity()).norm() < 1e-13);
    CHECK(p.U.determinant() == doctest::Approx(1));
    CHECK(p.sigma(0) >= p.sigma(1));
    CHECK(p.sigma(1) >= 0);
  };
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix<double, 3, 2> F = random_matrix(random).leftCols<2>();
    check(F);
    F.col(1) = 2 * F.col(0);
    check(F);
    F.col(1).setZero();
    check(F);
  }
  check(Eigen::Matrix<double, 3, 2>::Zero());
}
