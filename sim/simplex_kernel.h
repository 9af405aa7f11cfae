#pragma once
// Linear elements: tetrahedra (D = 3) and triangles (D = 2). F = Ds Dm^-1 (3 x D) is constant in each, its energy w
// psi(F) with w the rest volume (Sifakis and Barbic 2012, FEM course notes, chapter 4).
#include <vector>

#include "sim/element_term.h"
#include "sim/principal.h"

namespace softreel::sim {

/// A kernel of ElementTerm. Material has
///   static constexpr MaterialTraits kTraits;
///   double psi(const Deformation<D>&) const;            [J/m^3]
///   Deformation<D> pk1(const Deformation<D>&) const;    d psi / dF [Pa]
///   PrincipalHessian<D> hessian(const Stretches<D>&) const;
/// or, if that is the same for every F, a hessian() without argument, whose frame are the axes.
template <class Material, int D>
struct SimplexKernel {
  static constexpr int kCorners = D + 1;
  static constexpr bool kConstantHessian = requires(const Material& m) { m.hessian(); };

  struct Rest {
    Eigen::Matrix<double, D, D> gradient;  // Dm^-1; row a - 1: grad N_a of corner a = 1..D [1/m]
    double volume;                         // [m^3]
  };
  Material material;
  std::vector<Rest> rest;

  double energy(int e, const Corners<D + 1>& X) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    return r.volume * material.psi(deformation(X, r));
  }

  void gradient(int e, const Corners<D + 1>& X, Corners<D + 1>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const Deformation<D> P = material.pk1(deformation(X, r));
    out.template rightCols<D>().noalias() = r.volume * P * r.gradient.transpose();
    out.col(0) = -out.col(1);
    for (int a = 2; a <= D; ++a) out.col(0) -= out.col(a);
  }

  // K_ab = w sum_jl (grad N_a)_j (grad N_b)_l d2psi/dF_:j dF_:l. In the principal frame d2psi/dF2 is nearly diagonal,
  // so the sum is taken there: b_a = V^T grad N_a, K_ab = w U N U^T.
  void hessian(int e, const Corners<D + 1>& X, Definiteness definiteness, ElementHessian<D + 1>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    if constexpr (kConstantHessian) {
      PrincipalHessian<D> h = material.hessian();
      if (definiteness == Definiteness::kClamped) clamp(h);
      set_blocks(
          h, r.gradient.transpose(), [&](const Eigen::Matrix3d& N) { return r.volume * N; }, out);
    } else {
      const Principal<D> p = principal_stretches(deformation(X, r));
      PrincipalHessian<D> h = material.hessian(p.sigma);
      if (definiteness == Definiteness::kClamped) clamp(h);
      const auto turned = [&](const Eigen::Matrix3d& N) { return r.volume * p.U * N * p.U.transpose(); };
      set_blocks(h, p.V.transpose() * r.gradient.transpose(), turned, out);
    }
  }

 private:
  static Deformation<D> deformation(const Corners<D + 1>& X, const Rest& r) {
    Deformation<D> Ds;  // from corner 0, so that large coordinates do not cost digits
    for (int a = 0; a < D; ++a) Ds.col(a) = X.col(a + 1) - X.col(0);
    return Ds * r.gradient;
  }

  /// Upper blocks of `out`. `b`: gradients of the corners 1..D in the principal frame, in columns; `turned`: from that
  /// frame into the world. A surface has no gradient along its normal, the third axis.
  static void set_blocks(const PrincipalHessian<D>& h, const Eigen::Matrix<double, D, D>& b, const auto& turned,
                         ElementHessian<D + 1>& out) {
    Eigen::Matrix3d same, swapped, stretch = Eigen::Matrix3d::Zero();  // of (rj, rj), (rj, jr) and (rr, jj), r != j
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      same(i, j) = same(j, i) = 0.5 * (h.symmetric(k) + h.antisymmetric(k));
      swapped(i, j) = swapped(j, i) = 0.5 * (h.symmetric(k) - h.antisymmetric(k));
      same(k, k) = k < D ? h.stretch(k, k) : 0;
      swapped(k, k) = 0;
      if (i < D && j < D) stretch(i, j) = stretch(j, i) = h.stretch(i, j);
    }
    Eigen::Matrix<double, 3, D> B = Eigen::Matrix<double, 3, D>::Zero();
    B.template topRows<D>() = b;
    // A translation costs nothing: the rows of corner 0 are minus the sum of the others.
    Eigen::Matrix3d sums[D], corner = Eigen::Matrix3d::Zero();
    for (int c = 0; c < D; ++c) sums[c].setZero();
    for (int a = 0; a < D; ++a) {
      for (int c = a; c < D; ++c) {
        const Eigen::Matrix3d outer = B.col(a) * B.col(c).transpose();
        Eigen::Matrix3d N = stretch.cwiseProduct(outer) + swapped.cwiseProduct(outer.transpose());
        N.diagonal() = same * outer.diagonal();
        const Eigen::Matrix3d K = turned(N);
        out.template block<3, 3>(3 * (a + 1), 3 * (c + 1)) = K;
        sums[c] += K;
        if (a != c) sums[a] += K.transpose();
      }
    }
    for (int c = 0; c < D; ++c) {
      out.template block<3, 3>(0, 3 * (c + 1)) = -sums[c];
      corner += sums[c];
    }
    out.template block<3, 3>(0, 0) = corner;
  }
};

}  // namespace softreel::sim
