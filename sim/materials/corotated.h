#pragma once
// Corotated material without a volume term, also called as-rigid-as-possible: psi = mu |Sigma - I|^2 = mu |F - R|^2
// (Kim and Eberle 2022, "Dynamic deformables" course notes, section 3.4). Behaves as Poisson's ratio 0.
// Not differentiable where two singular values sum to zero (an element collapsed to a line or a point).
#include "sim/materials/invariants.h"
#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/polar.h"
#include "sim/principal.h"

namespace softreel::sim {

/// D = 3: a solid; D = 2: a sheet, with the constants of plane stress.
template <int D>
class Corotated {
 public:
  static constexpr MaterialTraits kTraits{.volume_term = false, .smooth_when_collapsed = false};

  explicit Corotated(const Lame& lame) : mu_(lame.mu) {}

  /// Energy density [J/m^3].
  double psi(const Deformation<D>& F) const { return mu_ * (F - rotation_of(F)).squaredNorm(); }

  /// First Piola-Kirchhoff stress [Pa].
  Deformation<D> pk1(const Deformation<D>& F) const { return 2 * mu_ * (F - rotation_of(F)); }

  PrincipalHessian<D> hessian(const Stretches<D>& sigma) const {
    return InvariantHessian<D>(sigma).norm(mu_, 0).trace(-2 * mu_, 0).sum();
  }

 private:
  double mu_;
};

}  // namespace softreel::sim
