#include "sim/motion.h"

#include <algorithm>
#include <numbers>

namespace softreel::sim {

Eigen::Matrix3d euler_xyz(const Eigen::Vector3d& degrees) {
  const Eigen::Vector3d r = degrees * (std::numbers::pi / 180.0);
  return (Eigen::AngleAxisd(r.z(), Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(r.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(r.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Motion::Motion(std::vector<MotionKey> keys, const Eigen::Vector3d& pivot) : keys_(std::move(keys)), pivot_(pivot) {}

Eigen::Isometry3d Motion::pose(double t) const {
  Eigen::Isometry3d world = Eigen::Isometry3d::Identity();
  if (keys_.empty()) return world;
  const auto after =
      std::upper_bound(keys_.begin(), keys_.end(), t, [](double time, const MotionKey& key) { return time < key.t; });
  const MotionKey& b = after == keys_.end() ? keys_.back() : *after;
  const MotionKey& a = after == keys_.begin() ? keys_.front() : *(after - 1);
  const double s = b.t > a.t ? std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0) : 0.0;
  const Eigen::Vector3d translate = a.translate + s * (b.translate - a.translate);
  const Eigen::Vector3d rotate = a.rotate_deg + s * (b.rotate_deg - a.rotate_deg);
  world.linear() = euler_xyz(rotate);
  world.translation() = pivot_ + translate - world.linear() * pivot_;
  return world;
}

}  // namespace softreel::sim
