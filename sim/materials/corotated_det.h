#pragma once
// Corotated material with an exact volume term: psi = mu |Sigma - I|^2 + lambda/2 (J - 1)^2 (Stomakhin, Howes,
// Schroeder, Teran 2012, "Energetically consistent invertible elasticity", section 3.4: "fixed corotated").
// Not differentiable where two singular values sum to zero (an element collapsed to a line or a point).
#include "sim/materials/invariants.h"
#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/polar.h"
#include "sim/principal.h"

namespace softreel::sim {

/// D = 3: a solid; D = 2: a sheet, with the constants of plane stress.
template <int D>
class CorotatedDet {
 public:
  static constexpr MaterialTraits kTraits{.smooth_when_collapsed = false};

  explicit CorotatedDet(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  /// Energy density [J/m^3].
  double psi(const Deformation<D>& F) const {
    const double dilation = volume_ratio(F) - 1;
    return mu_ * (F - rotation_of(F)).squaredNorm() + 0.5 * lambda_ * dilation * dilation;
  }

  /// First Piola-Kirchhoff stress [Pa].
  Deformation<D> pk1(const Deformation<D>& F) const {
    const VolumeRatio<D> volume(F);
    return 2 * mu_ * (F - rotation_of(F)) + lambda_ * (volume.J - 1) * volume.gradient;
  }

  PrincipalHessian<D> hessian(const Stretches<D>& sigma) const {
    const double dilation = sigma.prod() - 1;
    return InvariantHessian<D>(sigma).norm(mu_, 0).trace(-2 * mu_, 0).volume(lambda_ * dilation, lambda_).sum();
  }

 private:
  double mu_, lambda_;
};

}  // namespace softreel::sim
