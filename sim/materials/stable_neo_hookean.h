#pragma once
// Stable neo-Hookean material (Smith, de Goes, Kim 2018, "Stable Neo-Hookean flesh simulation", with the logarithmic
// origin barrier of section 3.4): psi = mu'/2 (|F|^2 - D) + lambda'/2 (J - a)^2 - mu'/2 ln(|F|^2 + 1). As a solid it is
// finite and smooth when inverted or flat. The constants make it linear elasticity at rest: mu' = 4 mu/3, lambda' =
// lambda + 5 mu/6, a = 1 + 3 mu'/(4 lambda') for a solid; 3 mu/2, lambda + 2 mu/3, 1 + 2 mu'/(3 lambda') for a sheet.
#include <cmath>

#include "sim/materials/invariants.h"
#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/principal.h"

namespace softreel::sim {

/// D = 3: a solid; D = 2: a sheet, with the constants of plane stress.
template <int D>
class StableNeoHookean {
 public:
  /// |f_0 x f_1| of a sheet has no derivative where it vanishes.
  static constexpr MaterialTraits kTraits{.smooth_when_collapsed = D == 3};

  explicit StableNeoHookean(const Lame& lame)
      : mu_((D + 1) * lame.mu / D),
        lambda_(lame.lambda + lame.mu * (1 - 2.0 / (D * (D + 1)))),
        a_(1 + lame.mu / lambda_) {}

  /// Energy density [J/m^3]; its constant makes psi(I) = 0.
  double psi(const Deformation<D>& F) const {
    const double I2 = F.squaredNorm(), J = volume_ratio(F);
    // Differences from the rest state, so that the energy of a small strain is not lost in rounding.
    return 0.5 * mu_ * (I2 - D) + 0.5 * lambda_ * (J - 1) * (J + 1 - 2 * a_) -
           0.5 * mu_ * std::log1p((I2 - D) / (D + 1));
  }

  /// First Piola-Kirchhoff stress [Pa].
  Deformation<D> pk1(const Deformation<D>& F) const {
    const VolumeRatio<D> volume(F);
    return mu_ * (1 - 1 / (F.squaredNorm() + 1)) * F + lambda_ * (volume.J - a_) * volume.gradient;
  }

  PrincipalHessian<D> hessian(const Stretches<D>& sigma) const {
    const double s = 1 / (sigma.squaredNorm() + 1);
    return InvariantHessian<D>(sigma)
        .norm(0.5 * mu_ * (1 - s), 0.5 * mu_ * s * s)
        .volume(lambda_ * (sigma.prod() - a_), lambda_)
        .sum();
  }

  NormAndVolume norm_and_volume(const Deformation<3>& F) const requires(D == 3) {
    const double s = 1 / (F.squaredNorm() + 1);
    const VolumeRatio<3> volume(F);
    return {0.5 * mu_ * (1 - s), 0.5 * mu_ * s * s, lambda_ * (volume.J - a_), lambda_, F, volume.gradient};
  }

 private:
  double mu_, lambda_, a_;
};

}  // namespace softreel::sim
