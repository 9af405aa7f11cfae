#pragma once
// Linear elements: tetrahedra (D = 3) and triangles (D = 2). F = Ds Dm^-1 (3 x D) is constant in each, its energy w
// psi(F) with w the rest volume (Sifakis and Barbic 2012, FEM course notes, chapter 4).
#include <vector>

#include "sim/element_term.h"
#include "sim/materials/invariants.h"
#include "sim/principal.h"

namespace softreel::sim {

/// A kernel of ElementTerm. Material has
///   static constexpr MaterialTraits kTraits;
///   double psi(const Deformation<D>&) const;            [J/m^3]
///   Deformation<D> pk1(const Deformation<D>&) const;    d psi / dF [Pa]
///   PrincipalHessian<D> hessian(const Stretches<D>&) const;
/// or, if that is the same for every F, a hessian() without argument, whose frame are the axes. A solid's material that
/// is a function of |F|^2 and J may also have
///   NormAndVolume norm_and_volume(const Deformation<3>&) const;
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
          h, r.gradient.transpose(), [&](const Eigen::Matrix3d& N) -> Eigen::Matrix3d { return r.volume * N; }, out);
    } else if constexpr (kClosedForm) {
      if (definiteness == Definiteness::kExact) return exact(r, material.norm_and_volume(deformation(X, r)), out);
      principal(r, deformation(X, r), definiteness, out);
    } else {
      principal(r, deformation(X, r), definiteness, out);
    }
  }

 private:
  static constexpr bool kClosedForm = D == 3 && requires(const Material& m, const Deformation<D>& F) {
    m.norm_and_volume(F);
  };

  void principal(const Rest& r, const Deformation<D>& F, Definiteness definiteness, ElementHessian<D + 1>& out) const {
    const Principal<D> p = principal_stretches(F);
    PrincipalHessian<D> h = material.hessian(p.sigma);
    if (definiteness == Definiteness::kClamped) clamp(h);
    const auto turned = [&](const Eigen::Matrix3d& N) -> Eigen::Matrix3d {
      return r.volume * p.U * N * p.U.transpose();
    };
    set_blocks(h, p.V.transpose() * r.gradient.transpose(), turned, out);
  }

  /// Of psi = g(|F|^2) + h(J), without a singular value decomposition: with f_a = F grad N_a and c_a = dJ/dF grad N_a,
  /// K_ab = w (2 g' grad N_a . grad N_b I + 4 g'' f_a f_b^T + h'' c_a c_b^T - h' [F (grad N_a x grad N_b)]_x).
  static void exact(const Rest& r, const NormAndVolume& m, ElementHessian<D + 1>& out) {
    const Eigen::Matrix3d g = r.gradient.transpose();
    const Eigen::Matrix3d f = m.F * g, c = m.dJ * g;
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) {
        Eigen::Matrix3d K = (4 * m.ddg * r.volume * f.col(a)) * f.col(b).transpose() +
                            (m.ddh * r.volume * c.col(a)) * c.col(b).transpose();
        K.diagonal().array() += 2 * m.dg * r.volume * g.col(a).dot(g.col(b));
        if (a != b) {
          const Eigen::Vector3d s = -m.dh * r.volume * (m.F * g.col(a).cross(g.col(b)));
          K(0, 1) -= s(2), K(1, 0) += s(2);
          K(0, 2) += s(1), K(2, 0) -= s(1);
          K(1, 2) -= s(0), K(2, 1) += s(0);
        }
        out.template block<3, 3>(3 * (a + 1), 3 * (b + 1)) = K;
      }
    set_first_rows(out);
  }

  static Deformation<D> deformation(const Corners<D + 1>& X, const Rest& r) {
    Deformation<D> Ds;  // from corner 0, so that large coordinates do not cost digits
    for (int a = 0; a < D; ++a) Ds.col(a) = X.col(a + 1) - X.col(0);
    return Ds * r.gradient;
  }

  /// Upper blocks of `out`. `b`: gradients of the corners 1..D in the principal frame, in columns; `turned`: from that
  /// frame into the world. A surface has no gradient along its normal, the third axis.
  static void set_blocks(const PrincipalHessian<D>& h, const Eigen::Matrix<double, D, D>& b, const auto& turned,
                         ElementHessian<D + 1>& out) {
    Eigen::Matrix3d same, swapped;  // coefficients of (rj, rj) and of (rj, jr)
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      same(i, j) = same(j, i) = 0.5 * (h.symmetric(k) + h.antisymmetric(k));
      swapped(i, j) = swapped(j, i) = 0.5 * (h.symmetric(k) - h.antisymmetric(k));
      if (k < D) same(k, k) = h.stretch(k, k);
    }
    for (int a = 0; a < D; ++a) {
      for (int c = a; c < D; ++c) {
        Eigen::Matrix3d N;
        for (int row = 0; row < 3; ++row) {
          if constexpr (D == 3)
            N(row, row) =
                same(row, 0) * b(0, a) * b(0, c) + same(row, 1) * b(1, a) * b(1, c) + same(row, 2) * b(2, a) * b(2, c);
          else
            N(row, row) = same(row, 0) * b(0, a) * b(0, c) + same(row, 1) * b(1, a) * b(1, c);
          for (int col = 0; col < 3; ++col) {
            if (col == row) continue;
            if (row < D && col < D)
              N(row, col) = h.stretch(row, col) * b(row, a) * b(col, c) + swapped(row, col) * b(col, a) * b(row, c);
            else
              N(row, col) = 0;
          }
        }
        out.template block<3, 3>(3 * (a + 1), 3 * (c + 1)) = turned(N);
      }
    }
    set_first_rows(out);
  }

  /// A translation costs nothing: the rows of corner 0 are minus the sum of the others.
  static void set_first_rows(ElementHessian<D + 1>& out) {
    const auto K = [&](int a, int c) { return out.template block<3, 3>(3 * a, 3 * c); };
    if constexpr (D == 3) {
      K(0, 1) = -(K(1, 1) + K(1, 2).transpose() + K(1, 3).transpose());
      K(0, 2) = -(K(1, 2) + K(2, 2) + K(2, 3).transpose());
      K(0, 3) = -(K(1, 3) + K(2, 3) + K(3, 3));
      K(0, 0) = -(K(0, 1) + K(0, 2) + K(0, 3));
    } else {
      K(0, 1) = -(K(1, 1) + K(1, 2).transpose());
      K(0, 2) = -(K(1, 2) + K(2, 2));
      K(0, 0) = -(K(0, 1) + K(0, 2));
    }
  }
};

}  // namespace softreel::sim
