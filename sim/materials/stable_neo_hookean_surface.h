#pragma once
// Stable neo-Hookean sheet: the solid's form (Smith, de Goes, Kim 2018) with J = sigma_0 sigma_1 and constants that
// match plane stress to first order: mu' = 3 mu/2, lambda' = lambda + 2 mu/3, a = 1 + 2 mu'/(3 lambda').
#include <Eigen/Geometry>
#include <cmath>

#include "sim/materials/lame.h"
#include "sim/principal.h"

namespace softreel::sim {

class StableNeoHookeanSurface {
 public:
  /// `lame`: of the surface (surface_lame).
  explicit StableNeoHookeanSurface(const Lame& lame)
      : mu_(1.5 * lame.mu), lambda_(lame.lambda + 2 * lame.mu / 3), a_(1 + 2 * mu_ / (3 * lambda_)) {}

  double psi(const Eigen::Matrix<double, 3, 2>& F) const {
    const double I2 = F.squaredNorm(), J = F.col(0).cross(F.col(1)).norm();
    return 0.5 * mu_ * (I2 - 2) + 0.5 * lambda_ * (J - 1) * (J + 1 - 2 * a_) - 0.5 * mu_ * std::log1p((I2 - 2) / 3);
  }

  Eigen::Matrix<double, 3, 2> pk1(const Eigen::Matrix<double, 3, 2>& F) const {
    const double I2 = F.squaredNorm();
    const Eigen::Vector3d area = F.col(0).cross(F.col(1));
    const double J = area.norm();
    Eigen::Matrix<double, 3, 2> P = mu_ * (1 - 1 / (I2 + 1)) * F;
    if (J > 0) {  // a triangle without area has no direction in which it would gain some
      const Eigen::Vector3d n = area / J;
      P.col(0) += lambda_ * (J - a_) * F.col(1).cross(n);
      P.col(1) += lambda_ * (J - a_) * n.cross(F.col(0));
    }
    return P;
  }

  PrincipalHessian2 hessian(const Eigen::Vector2d& sigma) const {
    const double I2 = sigma.squaredNorm(), J = sigma.prod();
    const double c = mu_ * (1 - 1 / (I2 + 1));
    const double p = lambda_ * (J - a_);
    const Eigen::Vector2d dJ(sigma(1), sigma(0));
    PrincipalHessian2 h;
    h.stretch = 2 * mu_ / ((I2 + 1) * (I2 + 1)) * sigma * sigma.transpose() + lambda_ * dJ * dJ.transpose();
    h.stretch.diagonal().array() += c;
    h.stretch(0, 1) += p;
    h.stretch(1, 0) += p;
    h.symmetric = c - p;
    h.antisymmetric = c + p;
    // psi_i / sigma_i; the pole of a triangle collapsed to a line is kept finite.
    for (int i = 0; i < 2; ++i) h.normal(i) = c + p * sigma(1 - i) / std::max(sigma(i), 1e-8);
    return h;
  }

 private:
  double mu_, lambda_, a_;
};

}  // namespace softreel::sim
