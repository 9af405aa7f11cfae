#pragma once
// Scripted rigid motion of pins and colliders, from key frames.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace softreel::sim {

struct MotionKey {
  double t = 0;                                          ///< [s]
  Eigen::Vector3d translate = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Vector3d rotate_deg = Eigen::Vector3d::Zero();  ///< Euler XYZ [deg]; turns beyond 180 count
};

/// Rotation by Euler angles, x first, then y, then z, about the world's axes [deg].
Eigen::Matrix3d euler_xyz(const Eigen::Vector3d& degrees);

/// Translation and each angle interpolated linearly by themselves; held before the first and after the last key.
class Motion {
 public:
  Motion() = default;
  /// `keys` in increasing t; rotation turns about `pivot` (world, [m]).
  Motion(std::vector<MotionKey> keys, const Eigen::Vector3d& pivot);

  bool still() const { return keys_.empty(); }
  /// world_at_t_from_world_at_rest
  Eigen::Isometry3d pose(double t) const;
  /// Velocity at time t of a point given where it is at rest [m/s]; at a key frame, that of before it.
  Eigen::Vector3d velocity(double t, const Eigen::Vector3d& at_rest) const;
  /// Is anything elsewhere at `to` than at `from`?
  bool moves(double from, double to) const;
  /// An upper bound of the turn between two times: the sum over the axes of how far each angle goes [deg].
  double turn(double from, double to) const;

 private:
  MotionKey at(double t) const;

  std::vector<MotionKey> keys_;
  Eigen::Vector3d pivot_ = Eigen::Vector3d::Zero();
};

}  // namespace softreel::sim
