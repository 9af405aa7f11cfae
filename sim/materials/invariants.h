#pragma once
// Isotropic materials are functions of three invariants of F = R S (Smith, de Goes, Kim 2019, "Analytic eigensystems
// for isotropic distortion energies", sections 3 and 4): t = tr(S), I2 = |F|^2 and J, the ratio of volumes (of areas on
// a surface). What a function of one of them adds to the Hessian in the principal frame is written here once; p and q
// are its first and second derivative.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/principal.h"

namespace softreel::sim {

inline double volume_ratio(const Deformation<3>& F) { return F.col(0).dot(F.col(1).cross(F.col(2))); }
inline double volume_ratio(const Deformation<2>& F) { return F.col(0).cross(F.col(1)).norm(); }

/// J and dJ/dF.
template <int D>
struct VolumeRatio;

template <>
struct VolumeRatio<3> {
  explicit VolumeRatio(const Deformation<3>& F) {
    gradient.col(0) = F.col(1).cross(F.col(2));
    gradient.col(1) = F.col(2).cross(F.col(0));
    gradient.col(2) = F.col(0).cross(F.col(1));
    J = F.col(0).dot(gradient.col(0));
  }
  double J;
  Deformation<3> gradient;
};

template <>
struct VolumeRatio<2> {
  explicit VolumeRatio(const Deformation<2>& F) {
    const Eigen::Vector3d area = F.col(0).cross(F.col(1));
    J = area.norm();
    if (J > 0) {
      const Eigen::Vector3d n = area / J;
      gradient.col(0) = F.col(1).cross(n);
      gradient.col(1) = n.cross(F.col(0));
    } else {
      gradient.setZero();  // a triangle without area has no direction in which it would gain some
    }
  }
  double J;
  Deformation<2> gradient;
};

/// Derivatives of psi = g(|F|^2) + h(J) of a solid by |F|^2 and J [Pa], with what a Hessian in the axes of space is
/// made of.
struct NormAndVolume {
  double dg, ddg, dh, ddh;
  Deformation<3> F, dJ;
};

/// The Hessian of psi = f(t) + g(I2) + h(J), summand by summand.
template <int D>
class InvariantHessian {
 public:
  explicit InvariantHessian(const Stretches<D>& sigma) : sigma_(sigma) {
    hessian_.stretch.setZero();
    hessian_.symmetric.setZero();
    hessian_.antisymmetric.setZero();
  }

  /// Of f(t): f'' between all stretches, and f' 2 / (sigma_i + sigma_j) for the turn of two axes.
  InvariantHessian& trace(double p, double q) {
    hessian_.stretch.array() += q;
    for (int k = 0; k < 3; ++k) {
      if (D == 2 && k < 2)
        normal(k, p / finite(sigma_(1 - k)));
      else
        hessian_.antisymmetric(k) += 2 * p / finite(sigma_((k + 1) % 3) + sigma_((k + 2) % 3));
    }
    return *this;
  }

  /// Of g(I2): 2 g' I + 4 g'' vec(F) vec(F)^T.
  InvariantHessian& norm(double p, double q) {
    hessian_.stretch += 4 * q * sigma_ * sigma_.transpose();
    hessian_.stretch.diagonal().array() += 2 * p;
    hessian_.symmetric.array() += 2 * p;
    hessian_.antisymmetric.array() += 2 * p;
    return *this;
  }

  /// Of h(J): h'' dJ dJ^T + h' d2J.
  InvariantHessian& volume(double p, double q) {
    Stretches<D> dJ;
    for (int i = 0; i < D; ++i) dJ(i) = D == 3 ? sigma_((i + 1) % 3) * sigma_((i + 2) % 3) : sigma_(1 - i);
    hessian_.stretch += q * dJ * dJ.transpose();
    for (int k = 0; k < 3; ++k) {
      if (D == 2 && k < 2) {
        normal(k, p * sigma_(k) / finite(sigma_(1 - k)));
        continue;
      }
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double third = D == 3 ? sigma_(k) : 1;  // d2J / d sigma_i d sigma_j
      hessian_.stretch(i, j) += p * third;
      hessian_.stretch(j, i) += p * third;
      hessian_.symmetric(k) -= p * third;
      hessian_.antisymmetric(k) += p * third;
    }
    return *this;
  }

  const PrincipalHessian<D>& sum() const { return hessian_; }

 private:
  // At a pole there is no derivative to give: keep the value finite.
  static double finite(double sum) {
    constexpr double kPole = 1e-8;
    return std::max(sum, kPole);
  }
  // Surface: the pair of in-plane axis 1 - k and the normal.
  void normal(int k, double value) {
    hessian_.symmetric(k) += value;
    hessian_.antisymmetric(k) += value;
  }

  Stretches<D> sigma_;
  PrincipalHessian<D> hessian_;
};

}  // namespace softreel::sim
