// What every material of the tables has to be, whatever its formula. F is set through one element with unit edges.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "sim/materials/lame.h"
#include "sim/membrane.h"
#include "sim/solid.h"
#include "tests/sim/derivatives.h"
#include "tests/sim/stretch_energies.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

constexpr double kYoung = 1e4;
constexpr double kEpsilon = 2.2e-16;
const double kRatios[] = {0.0, 0.3, 0.45, 0.49};

/// One element of the solid (dimensions = 3) or the sheet (2), thickness 1; F's columns are its edges.
struct Element {
  std::string material;
  int dimensions;
  double poisson;
  MaterialTraits traits;
  std::unique_ptr<EnergyTerm> term;

  Lame lame() const { return dimensions == 3 ? solid_lame(kYoung, poisson) : surface_lame(kYoung, poisson); }
  double volume() const { return dimensions == 3 ? 1.0 / 6 : 0.5; }
  Eigen::VectorXd corners(const Eigen::Matrix3d& F) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(3 * (dimensions + 1));
    for (int a = 0; a < dimensions; ++a) x.segment<3>(3 * (a + 1)) = F.col(a);
    return x;
  }
  double psi(const Eigen::Matrix3d& F) const { return term->value(corners(F)) / volume(); }
  Eigen::VectorXd forces(const Eigen::Matrix3d& F) const {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(3 * (dimensions + 1));
    term->add_gradient(corners(F), g);
    return g;
  }
  Eigen::MatrixXd hessian(const Eigen::Matrix3d& F, Definiteness d) const {
    return dense_hessian(*term, corners(F), d);
  }
};

void for_every_material(const auto& body) {
  const TetMesh tet{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}};
  const TriangleMesh triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
  for (double poisson : kRatios) {
    for (const MethodInfo& m : solid_materials()) {
      const std::string name(m.name);
      INFO("solid ", name, ", poisson ", poisson);
      body(Element{name, 3, poisson, solid_traits(name), make_solid(name, kYoung, poisson, tet, 0)});
    }
    for (const MethodInfo& m : membrane_materials()) {
      const std::string name(m.name);
      INFO("sheet ", name, ", poisson ", poisson);
      body(Element{name, 2, poisson, membrane_traits(name), make_membrane(name, kYoung, poisson, 1, triangle, 0)});
    }
  }
}

Eigen::Matrix3d turn(unsigned seed) {
  const Eigen::VectorXd r = random_vector(4, 1, seed);
  return Eigen::AngleAxisd(3 * r(3), r.head<3>().normalized()).toRotationMatrix();
}

}  // namespace

TEST_CASE("at rest every material has neither energy nor stress") {
  for_every_material([](const Element& e) {
    const double scale = e.lame().mu + e.lame().lambda;
    CHECK(std::abs(e.psi(Eigen::Matrix3d::Identity())) <= 4 * kEpsilon * scale);
    CHECK(e.forces(Eigen::Matrix3d::Identity()).norm() <= 16 * kEpsilon * scale);
  });
}

TEST_CASE("at rest every material is linear elasticity of the same constants") {
  for_every_material([](const Element& e) {
    const double mu = e.lame().mu, lambda = e.traits.volume_term ? e.lame().lambda : 0;
    // d2 psi / dF_ij dF_kl = mu (d_ik d_jl + d_il d_jk) + lambda d_ij d_kl; in the plane of a sheet alone.
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3 * (e.dimensions + 1), 3 * (e.dimensions + 1));
    Eigen::Matrix<double, 3, 4> N = Eigen::Matrix<double, 3, 4>::Zero();  // gradients of the corners
    for (int a = 1; a <= e.dimensions; ++a) {
      N(a - 1, a) = 1;
      N(a - 1, 0) = -1;
    }
    Eigen::Matrix3d plane = Eigen::Matrix3d::Identity();
    if (e.dimensions == 2) plane(2, 2) = 0;
    for (int a = 0; a <= e.dimensions; ++a)
      for (int b = 0; b <= e.dimensions; ++b)
        expected.block<3, 3>(3 * a, 3 * b) =
            e.volume() * (mu * N.col(a).dot(N.col(b)) * plane + mu * N.col(b) * N.col(a).transpose() +
                          lambda * N.col(a) * N.col(b).transpose());
    for (const Definiteness d : {Definiteness::kExact, Definiteness::kClamped}) {
      const Eigen::MatrixXd H = e.hessian(Eigen::Matrix3d::Identity(), d);
      CHECK((H - expected).norm() <= 64 * kEpsilon * expected.norm());
    }
  });
}

TEST_CASE("turning a body gives no elastic force, but with linear") {
  for_every_material([](const Element& e) {
    const double scale = e.lame().mu + e.lame().lambda;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Eigen::Matrix3d R = turn(seed);
      const double force = e.forces(R).norm();
      if (e.traits.rotation_invariant)
        CHECK(force <= 64 * kEpsilon * scale);
      else
        CHECK(force > 1e-3 * scale);
      // A stretched one carries its forces along.
      const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + 0.3 * random_vector(9, 1, 100 + seed).reshaped(3, 3);
      if (!e.traits.rotation_invariant) continue;
      const Eigen::VectorXd f = e.forces(F), turned = e.forces(R * F);
      for (int a = 0; a <= e.dimensions; ++a)
        CHECK((turned.segment<3>(3 * a) - R * f.segment<3>(3 * a)).norm() <= 1e-12 * std::max(f.norm(), scale));
    }
  });
}

TEST_CASE("a linear body that turns by an angle wants to swell by half its square") {
  // e = (R + R^T)/2 - I: cos(angle) - 1 across the axis. Free to do so, the body grows by 1/cos(angle) across it.
  const TetMesh tet{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}};
  const auto term = make_solid("linear", kYoung, 0.3, tet, 0);
  const Element e{"linear", 3, 0.3, solid_traits("linear"), make_solid("linear", kYoung, 0.3, tet, 0)};
  for (double angle : {0.01, 0.1, 0.5}) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const double shrink = std::cos(angle) - 1;
    const double expected = 2 * e.lame().mu * shrink * shrink + e.lame().lambda / 2 * 4 * shrink * shrink;
    CHECK(e.psi(R) == doctest::Approx(expected).scale(0).epsilon(1e-9));
    Eigen::Matrix3d swollen = R;
    swollen.leftCols<2>() /= std::cos(angle);
    CHECK(e.forces(swollen).norm() <= 1e-12 * kYoung);
  }
}

TEST_CASE("every material has the energy of its formula in principal stretches") {
  for_every_material([](const Element& e) {
    const double scale = e.lame().mu + e.lame().lambda;
    const auto D = static_cast<size_t>(e.dimensions);
    const double at_rest = stretch_energy(e.material, std::vector<Complex>(D, 1.0), e.lame()).real();
    for (unsigned seed = 1; seed <= 20; ++seed) {
      // As a reflection of a solid too: the last stretch takes the sign. A linear body is looked at along its axes.
      Eigen::Vector3d s = Eigen::Vector3d::Ones() + 0.9 * random_vector(3, 1, seed);
      std::sort(s.begin(), s.end(), std::greater<>());
      if (e.dimensions == 3 && seed % 2 == 0) s(2) = -0.9 * s(2);
      const Eigen::Matrix3d V =
          e.dimensions == 3 ? turn(200 + seed) : Eigen::AngleAxisd(seed, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const Eigen::Matrix3d U = e.traits.rotation_invariant ? turn(300 + seed) : V;
      const std::vector<Complex> stretches(s.begin(), s.begin() + e.dimensions);
      const double expected = stretch_energy(e.material, stretches, e.lame()).real() - at_rest;
      CHECK(e.psi(U * s.asDiagonal() * V.transpose()) ==
            doctest::Approx(expected).scale(0).epsilon(1e-11).scale(scale));
    }
  });
}

TEST_CASE("flat, inverted, collapsed, huge and tiny elements stay finite in every material") {
  for_every_material([](const Element& e) {
    const Eigen::Matrix3d R = turn(7), Q = turn(8);
    const Eigen::Vector3d stretches[] = {{1, 1, 1},        {1.2, 0.8, 0}, {1.2, 0, 0},      {0, 0, 0},
                                         {1, 1, -1},       {1, -1, 1},    {-1.2, -1, -0.8}, {1, 1e-9, 1e-12},
                                         {1, 1e-9, -1e-9}, {1, 1, 1e-16}};
    for (double size : {1.0, 1e6, 1e-9, 1e-200})
      for (const Eigen::Vector3d& s : stretches)
        for (const Eigen::Matrix3d& U : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), R}) {
          const Eigen::Matrix3d F = size * U * s.asDiagonal() * (U.isIdentity() ? U : Q);
          CAPTURE(size);
          CAPTURE(s.transpose());
          CHECK(std::isfinite(e.psi(F)));
          CHECK(e.forces(F).allFinite());
          CHECK(e.hessian(F, Definiteness::kExact).allFinite());
          const Eigen::MatrixXd C = e.hessian(F, Definiteness::kClamped);
          REQUIRE(C.allFinite());
          CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C).eigenvalues().minCoeff() >= -1e-10 * C.stableNorm());
        }
  });
}

TEST_CASE("only linear has a Hessian that is computed once") {
  for_every_material([](const Element& e) { CHECK(e.term->constant_hessian() == (e.material == "linear")); });
}
