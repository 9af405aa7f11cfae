#pragma once
// Symmetric Dirichlet energy: psi = mu/4 (|F|^2 + |F^-1|^2 - 6) (Smith and Schaefer 2015, "Bijective parameterization
// with free boundaries", section 3). Resists crushing without bound; for bodies that start uninverted.
#include "sim/materials/lame.h"
#include "sim/materials/traits.h"
#include "sim/principal.h"

namespace softreel::sim {

class SymmetricDirichlet {
 public:
  static constexpr MaterialTraits kTraits{.volume_term = false, .smooth_when_collapsed = false};

  explicit SymmetricDirichlet(const Lame& lame) : mu_(lame.mu) {}

  double psi(const Deformation<3>& F) const {
    const Stretches<3> s = principal_stretches(F).sigma;
    return mu_ / 4 * (s.squaredNorm() + s.cwiseInverse().squaredNorm() - 6);
  }

  Deformation<3> pk1(const Deformation<3>& F) const {  // U diag(d psi / d sigma) V^T
    const Principal<3> p = principal_stretches(F);
    return p.U * first(p.sigma).asDiagonal() * p.V.transpose();
  }

  PrincipalHessian<3> hessian(const Stretches<3>& s) const {
    const Stretches<3> inverse = s.cwiseInverse();
    PrincipalHessian<3> h;
    h.stretch = (mu_ / 2 * (1 + 3 * inverse.array().pow(4))).matrix().asDiagonal();
    for (int k = 0; k < 3; ++k) {  // (psi_i -+ psi_j) / (sigma_i -+ sigma_j) with the quotient written out
      const double a = inverse((k + 1) % 3), b = inverse((k + 2) % 3);
      h.symmetric(k) = mu_ / 2 * (1 + a * b * (a * a + a * b + b * b));
      h.antisymmetric(k) = mu_ / 2 * (1 - a * b * (a * a - a * b + b * b));
    }
    return h;
  }

 private:
  Stretches<3> first(const Stretches<3>& s) const { return mu_ / 2 * (s.array() - s.array().cube().inverse()); }

  double mu_;
};

}  // namespace softreel::sim
