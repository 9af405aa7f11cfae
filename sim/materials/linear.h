#pragma once
// Linear elasticity: psi = mu |e|^2 + lambda/2 tr(e)^2, e = (F + F^T)/2 - I (e.g. Sifakis and Barbic 2012, FEM course
// notes, section 3.2). Not rotation invariant: a body that turns by an angle swells by about half its square, so this
// is for small displacements, where it is exact and its constant Hessian cheap.
#include <Eigen/LU>

#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/principal.h"

namespace softreel::sim {

class Linear {
 public:
  static constexpr MaterialTraits kTraits{.rotation_invariant = false};

  explicit Linear(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  /// Energy density [J/m^3].
  double psi(const Deformation<3>& F) const {
    const Eigen::Matrix3d e = strain(F);
    return mu_ * e.squaredNorm() + 0.5 * lambda_ * e.trace() * e.trace();
  }

  /// First Piola-Kirchhoff stress [Pa].
  Deformation<3> pk1(const Deformation<3>& F) const {
    const Eigen::Matrix3d e = strain(F);
    return 2 * mu_ * e + lambda_ * e.trace() * Eigen::Matrix3d::Identity();
  }

  /// The same for every F; its principal frame are the axes.
  PrincipalHessian<3> hessian() const {
    PrincipalHessian<3> h;
    h.stretch = Eigen::Matrix3d::Constant(lambda_);
    h.stretch.diagonal().array() += 2 * mu_;
    h.symmetric.setConstant(2 * mu_);
    h.antisymmetric.setZero();
    return h;
  }

 private:
  static Eigen::Matrix3d strain(const Deformation<3>& F) {
    return 0.5 * (F + F.transpose()) - Eigen::Matrix3d::Identity();
  }

  double mu_, lambda_;
};

}  // namespace softreel::sim
