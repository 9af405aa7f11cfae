#pragma once
// St. Venant-Kirchhoff sheet in plane stress: psi = mu |G|^2 + lambda/2 tr(G)^2, G = (F^T F - I)/2, F 3x2.
#include <Eigen/LU>

#include "sim/materials/lame.h"
#include "sim/principal.h"

namespace softreel::sim {

class StvkSurface {
 public:
  /// `lame`: of the surface (surface_lame).
  explicit StvkSurface(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double psi(const Eigen::Matrix<double, 3, 2>& F) const {
    const Eigen::Matrix2d G = green(F);
    return mu_ * G.squaredNorm() + 0.5 * lambda_ * G.trace() * G.trace();
  }

  Eigen::Matrix<double, 3, 2> pk1(const Eigen::Matrix<double, 3, 2>& F) const {
    const Eigen::Matrix2d G = green(F);
    return F * (2 * mu_ * G + lambda_ * G.trace() * Eigen::Matrix2d::Identity());
  }

  PrincipalHessian2 hessian(const Eigen::Vector2d& sigma) const {
    const Eigen::Vector2d e = 0.5 * (sigma.array().square() - 1);
    const Eigen::Vector2d s = 2 * mu_ * e + Eigen::Vector2d::Constant(lambda_ * e.sum());  // psi_i / sigma_i
    PrincipalHessian2 h;
    h.stretch = lambda_ * sigma * sigma.transpose();
    h.stretch.diagonal() += s + 2 * mu_ * sigma.cwiseAbs2();
    h.symmetric = s(0) + sigma(1) * mu_ * (sigma(0) + sigma(1));
    h.antisymmetric = s(0) - sigma(1) * mu_ * (sigma(0) - sigma(1));
    h.normal = s;
    return h;
  }

 private:
  static Eigen::Matrix2d green(const Eigen::Matrix<double, 3, 2>& F) {
    return 0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity());
  }

  double mu_, lambda_;
};

}  // namespace softreel::sim
