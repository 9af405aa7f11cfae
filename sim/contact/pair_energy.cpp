// The distance is d = min over beta of |r(x, beta)|. Its derivatives follow from those of D = |r|^2/2 by the implicit
// function theorem: with T_k = dr/dbeta_k, orthonormalized to tangents q with the rates w_q = dw/dbeta_q,
//   grad d = w (x) n,
//   hess d = (1/d) ww^T (x) (I - nn^T - sum qq^T) - sum (w w_q^T (x) q n^T + its transpose) - d sum w_q w_q^T (x) nn^T.
// With psi' < 0 the first part is negative semi-definite, and orthogonal to all the rest: clamped away. The rest lives
// in the span of w (x) q and {w, w_q} (x) n, at most 5 dimensions, where its eigenvalues are found and clamped.
#include "sim/contact/pair_energy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace softreel::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

constexpr double kParallel = 1e-3;  // of |u|^2 |v|^2 at rest

Vector4 vector4(const FourNumbers& numbers) { return Vector4(numbers.data()); }

/// w (x) direction
Vector12 spread(const Vector4& w, const Vector3d& direction) {
  Vector12 result;
  for (int i = 0; i < 4; ++i) result.segment<3>(3 * i) = w(i) * direction;
  return result;
}

/// Orthonormal tangents and the rates of the weights along them.
struct Tangents {
  int count = 0;
  Vector3d q[2];
  Vector4 rate[2];
};

Tangents tangents_of(const FourPoints& x, const ClosestPoints& c) {
  Tangents result;
  for (int k = 0; k < c.parameters; ++k) {
    Vector4 rate = vector4(c.rates[static_cast<size_t>(k)]);
    Vector3d T = Vector3d::Zero();
    // Rates add up to zero: written as differences, a far origin costs no digits.
    for (size_t i = 0; i < 4; ++i) T += rate(static_cast<Eigen::Index>(i)) * (x[i] - x[0]);
    const double length = T.norm();
    if (result.count == 1) {
      const double share = result.q[0].dot(T);
      T -= share * result.q[0];
      rate -= share * result.rate[0];
    }
    const double left = T.norm();
    if (!(left > 1e-9 * length)) continue;  // parallel edges, flat triangles: no freedom of its own
    result.q[result.count] = T / left;
    result.rate[result.count++] = rate / left;
  }
  return result;
}

/// psi' = -first < 0 and psi'' = second > 0 of the distance.
void distance_hessian(const FourPoints& x, const ClosestPoints& c, double first, double second,
                      Definiteness definiteness, Matrix12& H) {
  const Vector3d n = c.r / c.distance;
  const Vector4 w = vector4(c.weights);
  const Tangents t = tangents_of(x, c);
  if (definiteness == Definiteness::kExact) {
    const Vector12 along = spread(w, n);
    H.noalias() = second * along * along.transpose();
    Matrix3d across = Matrix3d::Identity() - n * n.transpose();
    for (int k = 0; k < t.count; ++k) {
      across -= t.q[k] * t.q[k].transpose();
      const Vector12 turn = spread(t.rate[k], n), shift = spread(w, t.q[k]);
      H += first * (shift * turn.transpose() + turn * shift.transpose());
      H += first * c.distance * turn * turn.transpose();
    }
    across *= first / c.distance;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) H.block<3, 3>(3 * i, 3 * j) -= w(i) * w(j) * across;
    return;
  }
  // Orthonormal basis g of span{w, rates}, and the rates in it.
  Vector4 g[3] = {w / w.norm(), Vector4::Zero(), Vector4::Zero()};
  int basis = 1;
  for (int k = 0; k < t.count; ++k) {
    Vector4 rest = t.rate[k];
    for (int j = 0; j < basis; ++j) rest -= g[j].dot(rest) * g[j];
    const double norm = rest.norm();
    if (norm > 1e-12 * t.rate[k].norm()) g[basis++] = rest / norm;
  }
  const int size = basis + t.count;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 5, 5> M(size, size);
  M.setZero();
  M(0, 0) = second * w.squaredNorm();
  for (int k = 0; k < t.count; ++k)
    for (int i = 0; i < basis; ++i) {
      const double ci = g[i].dot(t.rate[k]);
      M(i, basis + k) = M(basis + k, i) = first * w.norm() * ci;
      for (int j = 0; j < basis; ++j) M(i, j) += first * c.distance * ci * g[j].dot(t.rate[k]);
    }
  Vector12 axis[5];
  for (int i = 0; i < basis; ++i) axis[i] = spread(g[i], n);
  for (int k = 0; k < t.count; ++k) axis[basis + k] = spread(g[0], t.q[k]);
  H.setZero();
  if (size == 1) {
    H.noalias() = M(0, 0) * axis[0] * axis[0].transpose();
    return;
  }
  const Eigen::SelfAdjointEigenSolver<decltype(M)> eigen(M);
  for (int e = 0; e < size; ++e) {
    if (eigen.eigenvalues()(e) <= 0) continue;
    Vector12 mode = Vector12::Zero();
    for (int i = 0; i < size; ++i) mode += eigen.eigenvectors()(i, e) * axis[i];
    H.noalias() += eigen.eigenvalues()(e) * mode * mode.transpose();
  }
}

/// The factor that fades parallel edges out, a function of c = |u x v|^2.
struct Fading {
  double share = 1, first = 0, second = 0;  // m, dm/dc, d2m/dc2
  Vector3d u, v;
};

Fading fading(PairKind kind, const FourPoints& x, const PairPenalty& penalty) {
  Fading f;
  if (kind == PairKind::kPointTriangle || penalty.cross_rest <= 0) return f;
  f.u = x[1] - x[0];
  f.v = x[3] - x[2];
  const double c = f.u.cross(f.v).squaredNorm(), end = kParallel * penalty.cross_rest;
  if (c >= end) return f;
  f.share = (2 - c / end) * c / end;
  f.first = 2 * (1 - c / end) / end;
  f.second = -2 / (end * end);
  return f;
}

/// Gradient of |u x v|^2 = |u|^2 |v|^2 - (u.v)^2 over the four vertices.
Vector12 cross_gradient(const Fading& f) {
  const double uv = f.u.dot(f.v);
  const Vector3d du = 2 * (f.v.squaredNorm() * f.u - uv * f.v), dv = 2 * (f.u.squaredNorm() * f.v - uv * f.u);
  Vector12 g;
  g.segment<3>(0) = -du;
  g.segment<3>(3) = du;
  g.segment<3>(6) = -dv;
  g.segment<3>(9) = dv;
  return g;
}

Matrix12 cross_hessian(const Fading& f) {
  const double uv = f.u.dot(f.v);
  const Matrix3d uu = 2 * (f.v.squaredNorm() * Matrix3d::Identity() - f.v * f.v.transpose());
  const Matrix3d vv = 2 * (f.u.squaredNorm() * Matrix3d::Identity() - f.u * f.u.transpose());
  const Matrix3d mixed =
      2 * (2 * f.u * f.v.transpose() - f.v * f.u.transpose() - uv * Matrix3d::Identity());  // d2c/(du dv)
  const Matrix3d mixed_transposed = mixed.transpose();
  // d2c/(dx_i dx_j): each edge is the difference of its two vertices.
  Matrix12 H;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double sign = i % 2 == j % 2 ? 1 : -1;
      const Matrix3d& part = i < 2 ? (j < 2 ? uu : mixed) : (j < 2 ? mixed_transposed : vv);
      H.block<3, 3>(3 * i, 3 * j) = sign * part;
    }
  return H;
}

void clamp_eigenvalues(Matrix12& H) {
  const Eigen::SelfAdjointEigenSolver<Matrix12> eigen(H);
  if (eigen.eigenvalues()(0) >= 0) return;
  const Vector12 clamped = eigen.eigenvalues().cwiseMax(0.0);
  H = eigen.eigenvectors() * clamped.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

double parallel_share(PairKind kind, const FourPoints& x, const PairPenalty& penalty) {
  return fading(kind, x, penalty).share;
}

double pair_value(PairKind kind, const FourPoints& x, const ClosestPoints& c, const PairPenalty& penalty) {
  const double s = penalty.intrusion(c.distance);
  return fading(kind, x, penalty).share * penalty.stiffness / 3 * s * s * s;
}

void pair_gradient(PairKind kind, const FourPoints& x, const ClosestPoints& c, const PairPenalty& penalty,
                   FourPoints& gradient) {
  const double s = penalty.intrusion(c.distance);
  const Fading f = fading(kind, x, penalty);
  const Vector3d pull = -f.share * penalty.force(s) / c.distance * c.r;
  for (size_t i = 0; i < 4; ++i) gradient[i] = c.weights[i] * pull;
  if (f.share == 1) return;
  const Vector12 turn = penalty.stiffness / 3 * s * s * s * f.first * cross_gradient(f);
  for (size_t i = 0; i < 4; ++i) gradient[i] += turn.segment<3>(3 * static_cast<Eigen::Index>(i));
}

void pair_hessian(PairKind kind, const FourPoints& x, const ClosestPoints& c, const PairPenalty& penalty,
                  Definiteness definiteness, Matrix12& H) {
  const double s = penalty.intrusion(c.distance);
  const double first = penalty.force(s), second = 2 * penalty.stiffness * s;
  const Fading f = fading(kind, x, penalty);
  if (f.share == 1) return distance_hessian(x, c, first, second, definiteness, H);
  distance_hessian(x, c, first, second, Definiteness::kExact, H);
  const double psi = penalty.stiffness / 3 * s * s * s;
  const Vector12 dpsi = spread(vector4(c.weights), -first / c.distance * c.r), dc = cross_gradient(f);
  H *= f.share;
  H += psi * f.first * cross_hessian(f) + psi * f.second * dc * dc.transpose();
  H += f.first * (dc * dpsi.transpose() + dpsi * dc.transpose());
  if (definiteness == Definiteness::kClamped) clamp_eigenvalues(H);
}

}  // namespace softreel::sim
