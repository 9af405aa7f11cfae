#pragma once
// General corotated solid: psi = mu |Sigma - I|^2 + lambda/2 tr(Sigma - I)^2 (Sifakis and Barbic 2012, FEM course
// notes, section 3.4). Linear elasticity in the rotated frame; stiffest known to stay cheap under large rotations.
// Not differentiable where two singular values sum to zero (an element collapsed to a line or a point).
#include <cmath>

#include "sim/materials/lame.h"
#include "sim/principal.h"

namespace softreel::sim {

class CorotatedVolume {
 public:
  explicit CorotatedVolume(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double psi(const Eigen::Matrix3d& F) const {
    const Eigen::Vector3d e = principal_stretches(F).sigma - Eigen::Vector3d::Ones();
    return mu_ * e.squaredNorm() + 0.5 * lambda_ * e.sum() * e.sum();
  }

  Eigen::Matrix3d pk1(const Eigen::Matrix3d& F) const {
    const Principal3 p = principal_stretches(F);
    return p.U * first(p.sigma).asDiagonal() * p.V.transpose();
  }

  PrincipalHessian3 hessian(const Eigen::Vector3d& sigma) const {
    const Eigen::Vector3d psi_i = first(sigma);
    PrincipalHessian3 h;
    h.stretch = Eigen::Matrix3d::Constant(lambda_);
    h.stretch.diagonal().array() += 2 * mu_;
    h.symmetric.setConstant(2 * mu_);
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double sum = sigma(i) + sigma(j);
      // The pole has no derivative to give: keep the value finite there.
      const double safe = std::abs(sum) > kPole ? sum : std::copysign(kPole, sum);
      h.antisymmetric(k) = (psi_i(i) + psi_i(j)) / safe;
    }
    return h;
  }

 private:
  static constexpr double kPole = 1e-8;

  Eigen::Vector3d first(const Eigen::Vector3d& sigma) const {
    const Eigen::Vector3d e = sigma - Eigen::Vector3d::Ones();
    return 2 * mu_ * e + Eigen::Vector3d::Constant(lambda_ * e.sum());
  }

  double mu_, lambda_;
};

}  // namespace softreel::sim
