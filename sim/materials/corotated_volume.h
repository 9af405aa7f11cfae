#pragma once
// General corotated material: psi = mu |Sigma - I|^2 + lambda/2 tr(Sigma - I)^2 (Sifakis and Barbic 2012, FEM course
// notes, section 3.4): linear elasticity in the rotated frame; the stiffest known to stay cheap under large rotations.
// Not differentiable where two singular values sum to zero (an element collapsed to a line or a point).
#include "sim/materials/invariants.h"
#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/polar.h"
#include "sim/principal.h"

namespace softreel::sim {

/// D = 3: a solid; D = 2: a sheet, with the constants of plane stress.
template <int D>
class CorotatedVolume {
 public:
  static constexpr MaterialTraits kTraits{.smooth_when_collapsed = false};

  explicit CorotatedVolume(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  /// Energy density [J/m^3].
  double psi(const Deformation<D>& F) const {
    const Deformation<D> R = rotation_of(F), U = F - R;
    const double trace = R.cwiseProduct(U).sum();  // tr(Sigma - I), without the rounding of D
    return mu_ * U.squaredNorm() + 0.5 * lambda_ * trace * trace;
  }

  /// First Piola-Kirchhoff stress [Pa].
  Deformation<D> pk1(const Deformation<D>& F) const {
    const Deformation<D> R = rotation_of(F), U = F - R;
    return 2 * mu_ * U + lambda_ * R.cwiseProduct(U).sum() * R;
  }

  PrincipalHessian<D> hessian(const Stretches<D>& sigma) const {
    const double trace = sigma.sum() - D;
    return InvariantHessian<D>(sigma).norm(mu_, 0).trace(lambda_ * trace - 2 * mu_, lambda_).sum();
  }

 private:
  double mu_, lambda_;
};

}  // namespace softreel::sim
