#pragma once
// Stable neo-Hookean solid (Smith, de Goes, Kim 2018, "Stable Neo-Hookean flesh simulation", with the logarithmic
// origin barrier of section 3.4): psi = mu'/2 (|F|^2 - 3) + lambda'/2 (J - a)^2 - mu'/2 ln(|F|^2 + 1),
// mu' = 4 mu/3, lambda' = lambda + 5 mu/6, a = 1 + 3 mu'/(4 lambda'). Finite and smooth when inverted or flat.
#include <Eigen/Geometry>
#include <cmath>

#include "sim/materials/lame.h"
#include "sim/principal.h"

namespace softreel::sim {

class StableNeoHookean {
 public:
  explicit StableNeoHookean(const Lame& lame)
      : mu_(4 * lame.mu / 3), lambda_(lame.lambda + 5 * lame.mu / 6), a_(1 + 3 * mu_ / (4 * lambda_)) {}

  /// Energy density [J/m^3]; its constant makes psi(I) = 0.
  double psi(const Eigen::Matrix3d& F) const {
    const double I2 = F.squaredNorm(), J = F.determinant();
    // ln((I2 + 1) / 4) and (J - a)^2 - (1 - a)^2, so that the energy of a small strain is not lost in rounding.
    return 0.5 * mu_ * (I2 - 3) + 0.5 * lambda_ * (J - 1) * (J + 1 - 2 * a_) - 0.5 * mu_ * std::log1p((I2 - 3) / 4);
  }

  /// First Piola-Kirchhoff stress [Pa].
  Eigen::Matrix3d pk1(const Eigen::Matrix3d& F) const {
    const double I2 = F.squaredNorm();
    Eigen::Matrix3d cofactor;  // dJ/dF
    cofactor.col(0) = F.col(1).cross(F.col(2));
    cofactor.col(1) = F.col(2).cross(F.col(0));
    cofactor.col(2) = F.col(0).cross(F.col(1));
    const double J = F.col(0).dot(cofactor.col(0));
    return mu_ * (1 - 1 / (I2 + 1)) * F + lambda_ * (J - a_) * cofactor;
  }

  PrincipalHessian3 hessian(const Eigen::Vector3d& sigma) const {
    const double I2 = sigma.squaredNorm(), J = sigma.prod();
    const double c = mu_ * (1 - 1 / (I2 + 1));
    const double p = lambda_ * (J - a_);
    const Eigen::Vector3d dJ(sigma(1) * sigma(2), sigma(2) * sigma(0), sigma(0) * sigma(1));
    PrincipalHessian3 h;
    h.stretch = 2 * mu_ / ((I2 + 1) * (I2 + 1)) * sigma * sigma.transpose() + lambda_ * dJ * dJ.transpose();
    h.stretch.diagonal().array() += c;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      h.stretch(i, j) += p * sigma(k);
      h.stretch(j, i) += p * sigma(k);
      h.symmetric(k) = c - p * sigma(k);
      h.antisymmetric(k) = c + p * sigma(k);
    }
    return h;
  }

 private:
  double mu_, lambda_, a_;
};

}  // namespace softreel::sim
