#pragma once
// Smoothed Coulomb friction (Li et al. 2020, "Incremental potential contact", section 5).
#include <Eigen/Core>

namespace softreel::sim {

/// f(u), the potential per force of sliding at the speed u >= 0 [m/s]: f' rises from 0 to 1 at the slip speed.
struct FrictionLaw {
  double slip_speed = 1e-3;  ///< friction holds below [m/s] > 0

  double value(double u) const {
    return u < slip_speed ? u * u / slip_speed - u * u * u / (3 * slip_speed * slip_speed) : u - slip_speed / 3;
  }
  /// f'(u)/u [s/m]
  double over_speed(double u) const { return u < slip_speed ? (2 - u / slip_speed) / slip_speed : 1 / u; }

  /// Of one touch with the unit normal n, whose sliding velocity is u (across n): the Hessian over u, positive
  /// semi-definite [s/m]. f'(u)/u (T - uu^T/u^2) + f''(u) uu^T/u^2. f'' falls from 2/slip_speed to 0 within slip_speed,
  /// so a Newton step that starts in slip knows nothing of the stick it may run across, leaps to the other side, and
  /// comes back the same way. Touches that a proposed step would turn around are modelled by their stick branch,
  /// u^2/slip_speed, instead (`stuck`): they end up in it, and if they should slip after all, Newton's method leaves it
  /// monotonically (f' is concave).
  Eigen::Matrix3d hessian(const Eigen::Vector3d& n, const Eigen::Vector3d& u, bool stuck) const {
    Eigen::Matrix3d D = Eigen::Matrix3d::Identity() - n * n.transpose();
    if (stuck) return D * (2 / slip_speed);
    const double speed = u.norm();
    D *= over_speed(speed);
    if (speed > 0) {
      const double second = speed < slip_speed ? 2 / slip_speed * (1 - speed / slip_speed) : 0.0;
      D += (second - over_speed(speed)) / (speed * speed) * u * u.transpose();
    }
    return D;
  }
  /// What the stick branch's f'(u)/u has over the true one [s/m].
  double excess(double u) const { return 2 / slip_speed - over_speed(u); }
  /// Would a step du (across the normal) turn the sliding u around?
  bool turned(const Eigen::Vector3d& u, const Eigen::Vector3d& du) const {
    return u.norm() > slip_speed && u.dot(u + du) < 0;
  }
};

}  // namespace softreel::sim
