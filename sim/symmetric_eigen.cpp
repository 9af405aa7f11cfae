#include "sim/symmetric_eigen.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace softreel::sim {
namespace {

/// The root in [sqrt(3), 2] of x^3 - 3 x - 2 r = 0, r in [0, 1]: Newton's method comes down to it from 2.
double largest_root(double r) {
  double x = 2;
  for (int i = 0; i < 8; ++i) {
    const double step = ((x * x - 3) * x - 2 * r) / (3 * (x * x - 1));
    x -= step;
    if (!(step > 1e-15)) break;
  }
  return x;
}

}  // namespace

void symmetric_eigen(const Eigen::Matrix3d& S, Eigen::Vector3d& values, Eigen::Matrix3d& V) {
  // The deviator scaled to |B|^2 = 6 has eigenvalues between -2 and 2, one of them at least sqrt(3) in size and
  // sqrt(3) away from both others: its eigenvector is well conditioned, and the others' are found in its complement.
  Eigen::Matrix3d B = S;
  B.diagonal().array() -= S.trace() / 3;
  const double scale = std::sqrt(B.squaredNorm() / 6);
  if (!(scale > std::numeric_limits<double>::epsilon() * S.cwiseAbs().maxCoeff())) {
    V.setIdentity();
    values.setConstant(S.trace() / 3);
    return;
  }
  B /= scale;
  const double r = std::clamp(0.5 * B.determinant(), -1.0, 1.0);
  const double apart = std::copysign(largest_root(std::abs(r)), r);
  Eigen::Matrix3d M = B;
  M.diagonal().array() -= apart;
  // Of rank 2: the cross product of two rows is the eigenvector; the longest is the most exact.
  Eigen::Vector3d w = M.col(0).cross(M.col(1));
  double longest = w.squaredNorm();
  for (const Eigen::Vector3d& other :
       {Eigen::Vector3d(M.col(1).cross(M.col(2))), Eigen::Vector3d(M.col(2).cross(M.col(0)))})
    if (other.squaredNorm() > longest) {
      longest = other.squaredNorm();
      w = other;
    }
  w /= std::sqrt(longest);
  Eigen::Vector3d u =
      std::abs(w.x()) > std::abs(w.y()) ? Eigen::Vector3d(-w.z(), 0, w.x()) : Eigen::Vector3d(0, w.z(), -w.y());
  u /= u.norm();
  const Eigen::Vector3d v = w.cross(u);
  // The complement, diagonalized by one rotation (Golub and Van Loan, section 8.5.2).
  const Eigen::Vector3d Bu = B * u, Bv = B * v;
  const double a = u.dot(Bu), b = v.dot(Bv), c = u.dot(Bv);
  double cosine = 1, sine = 0, t = 0;
  if (c != 0) {
    const double zeta = (b - a) / (2 * c);
    t = (zeta >= 0 ? 1.0 : -1.0) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
    cosine = 1 / std::sqrt(1 + t * t);
    sine = cosine * t;
  }
  const Eigen::Vector3d e = cosine * u - sine * v, f = sine * u + cosine * v;
  const double at_e = a - t * c, at_f = b + t * c;
  // w, e, f are right-handed; so is each of these orders.
  const double mean = S.trace() / 3, at_w = w.dot(B * w);
  const auto order = [&](const Eigen::Vector3d& v0, const Eigen::Vector3d& v1, const Eigen::Vector3d& v2, double l0,
                         double l1, double l2) {
    V << v0, v1, v2;
    values = Eigen::Vector3d(l0, l1, l2) * scale + Eigen::Vector3d::Constant(mean);
  };
  if (apart > 0 && at_e >= at_f)
    order(w, e, f, at_w, at_e, at_f);
  else if (apart > 0)
    order(w, f, -e, at_w, at_f, at_e);
  else if (at_e >= at_f)
    order(e, f, w, at_e, at_f, at_w);
  else
    order(f, -e, w, at_f, at_e, at_w);
}

}  // namespace softreel::sim
