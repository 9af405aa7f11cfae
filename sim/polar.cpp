#include "sim/polar.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "sim/materials/invariants.h"
#include "sim/principal.h"

namespace softreel::sim {
namespace {

// Below this the closed forms lose digits (about eps / kWellConditioned^2 is left); Jacobi rotations do not. A rotation
// has 16/27, a block pressed flat 1/2.
constexpr double kWellConditioned = 0.3;
constexpr double kFlat = 0.05;  // the same for a surface, J / |F|^2; a rotation has 1/2
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace

// R = d tr(S) / dF, and t = tr(S) is the largest root of t^4 - 2 |F|^2 t^2 - 8 det(F) t + |F|^4 - 4 |cof F|^2 (Horn
// 1987, "Closed-form solution of absolute orientation using unit quaternions", section 4.D; the other roots flip two
// signs of sigma). Newton's method from a bound above comes down to it (Theobald 2005): in two or three steps near a
// rotation, for sqrt(3) |F| is the root itself where all stretches are equal.
bool closed_form_rotation(const Deformation<3>& F, Deformation<3>& R) {
  const VolumeRatio<3> volume(F);
  const double I2 = F.squaredNorm(), J = volume.J;
  const double last = I2 * I2 - 4 * volume.gradient.squaredNorm();
  double t = std::sqrt(3 * I2);
  for (int i = 0; i < 20; ++i) {
    const double step = (((t * t - 2 * I2) * t - 8 * J) * t + last) / (4 * ((t * t - I2) * t - 2 * J));
    t -= step;
    if (!(step > 2 * kEpsilon * t)) break;
  }
  const double d = (t * t - I2) * t - 2 * J;  // 2 (sigma_0 + sigma_1) (sigma_1 + sigma_2) (sigma_2 + sigma_0)
  if (!(d > kWellConditioned * t * t * t)) return false;
  const Eigen::Matrix3d C = F.transpose() * F;
  R = ((t * t + I2) * F + 2 * t * volume.gradient - 2 * F * C) / d;
  return true;
}

Deformation<3> rotation_of(const Deformation<3>& F) {
  Deformation<3> R;
  if (closed_form_rotation(F, R)) return R;
  const Principal<3> p = principal_stretches(F);
  return p.U * p.V.transpose();
}

// Here t = tr(S) = sqrt(|F|^2 + 2 J), J the ratio of areas.
Deformation<2> rotation_of(const Deformation<2>& F) {
  const VolumeRatio<2> area(F);
  const double I2 = F.squaredNorm();
  if (!(area.J > kFlat * I2)) {
    const Principal<2> p = principal_stretches(F);
    return p.U.leftCols<2>() * p.V.transpose();
  }
  return (F + area.gradient) / std::sqrt(I2 + 2 * area.J);
}

}  // namespace softreel::sim
