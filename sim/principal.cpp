#include "sim/principal.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/element_term.h"
#include "sim/polar.h"
#include "sim/symmetric_eigen.h"

namespace softreel::sim {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTiny = std::numeric_limits<double>::min();

/// One-sided Jacobi rotation (Hestenes 1958) that makes columns i and j of B orthogonal; V takes the same rotation.
/// Returns false if they already were.
template <class MatrixB, class MatrixV>
bool orthogonalize(MatrixB& B, MatrixV& V, int i, int j) {
  const double a = B.col(i).squaredNorm();
  const double b = B.col(j).squaredNorm();
  const double c = B.col(i).dot(B.col(j));
  // B is scaled to entries of at most 1: what underflows here is far below its rounding.
  if (c * c <= kEpsilon * kEpsilon * a * b || std::abs(c) < kTiny) return false;
  const double zeta = (b - a) / (2.0 * c);
  const double t = (zeta >= 0 ? 1.0 : -1.0) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
  const double cosine = 1.0 / std::sqrt(1.0 + t * t);
  const double sine = cosine * t;
  const auto rotate = [&](auto& M) {
    for (int r = 0; r < M.rows(); ++r) {
      const double mi = M(r, i), mj = M(r, j);
      M(r, i) = cosine * mi - sine * mj;
      M(r, j) = sine * mi + cosine * mj;
    }
  };
  rotate(B);
  rotate(V);
  return true;
}

template <class MatrixB, class MatrixV, class Vector>
void swap_columns(MatrixB& B, MatrixV& V, Vector& length, int i, int j) {
  B.col(i).swap(B.col(j));
  V.col(i).swap(V.col(j));
  std::swap(length(i), length(j));
}

Eigen::Vector3d any_orthogonal(const Eigen::Vector3d& u) {
  int smallest = 0;
  u.cwiseAbs().minCoeff(&smallest);
  return u.cross(Eigen::Vector3d::Unit(smallest)).normalized();
}

/// First two columns of U from two orthogonal columns of lengths l0 >= l1, whatever of them is not zero.
void first_columns(Eigen::Matrix3d& U, const Eigen::Vector3d& b0, const Eigen::Vector3d& b1, double l0, double l1) {
  if (l0 < kTiny) {
    U.setIdentity();
    return;
  }
  U.col(0) = b0 / l0;
  // Below rounding of the first, the direction of the second column is noise: orthogonalize before use.
  Eigen::Vector3d second = l1 > 0 ? Eigen::Vector3d(b1 / l1) : Eigen::Vector3d::Zero();
  second -= U.col(0).dot(second) * U.col(0);
  const double length = second.norm();
  U.col(1) = length > 0.5 ? Eigen::Vector3d(second / length) : any_orthogonal(U.col(0));
  U.col(2) = U.col(0).cross(U.col(1));
}

template <int D>
void clamp_modes(PrincipalHessian<D>& h) {
  clamp_to_semidefinite<D>(h.stretch);
  h.symmetric = h.symmetric.cwiseMax(0.0);
  h.antisymmetric = h.antisymmetric.cwiseMax(0.0);
}

}  // namespace

Principal<3> principal_stretches(const Deformation<3>& F) {
  Principal<3> p;
  Eigen::Matrix3d R;
  if (closed_form_rotation(F, R)) {  // the usual case: F = R S, S = V Sigma V^T
    const Eigen::Matrix3d S = R.transpose() * F;
    symmetric_eigen(0.5 * (S + S.transpose()), p.sigma, p.V);
    p.U = R * p.V;
    return p;
  }
  const double scale = F.cwiseAbs().maxCoeff();
  if (!(scale > kTiny)) return {Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  Eigen::Matrix3d B = F / scale;
  p.V.setIdentity();
  for (int sweep = 0; sweep < 20; ++sweep) {
    bool rotated = orthogonalize(B, p.V, 0, 1);
    rotated |= orthogonalize(B, p.V, 0, 2);
    rotated |= orthogonalize(B, p.V, 1, 2);
    if (!rotated) break;
  }
  Eigen::Vector3d length(B.col(0).norm(), B.col(1).norm(), B.col(2).norm());
  if (length(0) < length(1)) swap_columns(B, p.V, length, 0, 1);
  if (length(1) < length(2)) swap_columns(B, p.V, length, 1, 2);
  if (length(0) < length(1)) swap_columns(B, p.V, length, 0, 1);
  if (p.V.determinant() < 0) {
    p.V.col(2) = -p.V.col(2);
    B.col(2) = -B.col(2);
  }
  first_columns(p.U, B.col(0), B.col(1), length(0), length(1));
  p.sigma = Eigen::Vector3d(length(0), length(1), p.U.col(2).dot(B.col(2))) * scale;
  return p;
}

Principal<2> principal_stretches(const Deformation<2>& F) {
  Principal<2> p;
  const double scale = F.cwiseAbs().maxCoeff();
  if (!(scale > kTiny)) return {Eigen::Matrix3d::Identity(), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()};
  Eigen::Matrix<double, 3, 2> B = F / scale;
  p.V.setIdentity();
  for (int sweep = 0; sweep < 4; ++sweep)
    if (!orthogonalize(B, p.V, 0, 1)) break;
  Eigen::Vector2d length(B.col(0).norm(), B.col(1).norm());
  if (length(0) < length(1)) swap_columns(B, p.V, length, 0, 1);
  first_columns(p.U, B.col(0), B.col(1), length(0), length(1));
  p.sigma = length * scale;
  return p;
}

void clamp(PrincipalHessian<3>& h) { clamp_modes(h); }
void clamp(PrincipalHessian<2>& h) { clamp_modes(h); }

}  // namespace softreel::sim
