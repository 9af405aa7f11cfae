#pragma once
// St. Venant-Kirchhoff: psi = mu |G|^2 + lambda/2 tr(G)^2, G = (F^T F - I)/2 (Ciarlet 1988, "Mathematical elasticity
// I", section 3.9). A polynomial of F, so smooth everywhere; does not see a reflection, and resists compression less
// and less below a stretch of 1/sqrt(3).
#include <Eigen/LU>

#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/principal.h"

namespace softreel::sim {

/// D = 3: a solid; D = 2: a sheet, with the constants of plane stress.
template <int D>
class Stvk {
 public:
  static constexpr MaterialTraits kTraits{};

  explicit Stvk(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  /// Energy density [J/m^3].
  double psi(const Deformation<D>& F) const {
    const Square G = green(F);
    return mu_ * G.squaredNorm() + 0.5 * lambda_ * G.trace() * G.trace();
  }

  /// First Piola-Kirchhoff stress [Pa].
  Deformation<D> pk1(const Deformation<D>& F) const {
    const Square G = green(F);
    return F * (2 * mu_ * G + lambda_ * G.trace() * Square::Identity());
  }

  PrincipalHessian<D> hessian(const Stretches<D>& sigma) const {
    Eigen::Vector3d s = Eigen::Vector3d::Zero();  // of a sheet, also along its normal
    s.head<D>() = sigma;
    const double pressure = 0.5 * lambda_ * (s.squaredNorm() - D);
    PrincipalHessian<D> h;
    h.stretch = lambda_ * sigma * sigma.transpose();
    h.stretch.diagonal().array() += mu_ * (3 * sigma.array().square() - 1) + pressure;
    for (int k = 0; k < 3; ++k) {
      const double a = s((k + 1) % 3), b = s((k + 2) % 3);
      h.symmetric(k) = mu_ * (a * a + a * b + b * b - 1) + pressure;
      h.antisymmetric(k) = mu_ * (a * a - a * b + b * b - 1) + pressure;
    }
    return h;
  }

 private:
  using Square = Eigen::Matrix<double, D, D>;
  static Square green(const Deformation<D>& F) { return 0.5 * (F.transpose() * F - Square::Identity()); }

  double mu_, lambda_;
};

}  // namespace softreel::sim
