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
  const MotionKey now = at(t);
  world.linear() = euler_xyz(now.rotate_deg);
  world.translation() = pivot_ + now.translate - world.linear() * pivot_;
  return world;
}

MotionKey Motion::at(double t) const {
  const auto after =
      std::upper_bound(keys_.begin(), keys_.end(), t, [](double time, const MotionKey& key) { return time < key.t; });
  const MotionKey& b = after == keys_.end() ? keys_.back() : *after;
  const MotionKey& a = after == keys_.begin() ? keys_.front() : *(after - 1);
  const double s = b.t > a.t ? std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0) : 0.0;
  return {t, a.translate + s * (b.translate - a.translate), a.rotate_deg + s * (b.rotate_deg - a.rotate_deg)};
}

Eigen::Vector3d Motion::velocity(double t, const Eigen::Vector3d& at_rest) const {
  using Eigen::Vector3d;
  // The key frames around t: a.t < t <= b.t.
  const auto b =
      std::lower_bound(keys_.begin(), keys_.end(), t, [](const MotionKey& key, double time) { return key.t < time; });
  if (b == keys_.begin() || b == keys_.end()) return Vector3d::Zero();
  const auto a = b - 1;
  const Vector3d rate = (b->rotate_deg - a->rotate_deg) / (b->t - a->t) * (std::numbers::pi / 180);
  const Vector3d translation = (b->translate - a->translate) / (b->t - a->t);
  const Vector3d angles = at(t).rotate_deg;
  const Eigen::Matrix3d Rz = euler_xyz({0, 0, angles.z()}), Ry = euler_xyz({0, angles.y(), 0});
  const Vector3d omega =
      rate.z() * Vector3d::UnitZ() + Rz * (rate.y() * Vector3d::UnitY() + Ry * (rate.x() * Vector3d::UnitX()));
  return translation + omega.cross(euler_xyz(angles) * (at_rest - pivot_));
}

bool Motion::moves(double from, double to) const { return !still() && pose(from).matrix() != pose(to).matrix(); }

double Motion::turn(double from, double to) const {
  if (keys_.empty()) return 0;
  double sum = 0;
  Eigen::Vector3d last = at(from).rotate_deg;
  const auto go_to = [&](const Eigen::Vector3d& angles) {
    sum += (angles - last).lpNorm<1>();
    last = angles;
  };
  for (const MotionKey& key : keys_)
    if (key.t > from && key.t < to) go_to(key.rotate_deg);
  go_to(at(to).rotate_deg);
  return sum;
}

}  // namespace softreel::sim
