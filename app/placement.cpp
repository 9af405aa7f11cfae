#include "app/placement.h"

#include "sim/motion.h"

namespace softreel::app {

void scale_about_pivot(const assets::Transform& t, std::vector<sim::Vec3>& vertices) {
  for (sim::Vec3& p : vertices) p = t.scale.cwiseProduct(p - t.pivot);
}

void place(const assets::Transform& t, std::vector<sim::Vec3>& vertices) {
  const Eigen::Matrix3d R = sim::euler_xyz(t.rotate);
  for (sim::Vec3& p : vertices) p = R * p + t.pivot + t.translate;
}

sim::Vec3 placed(const assets::Transform& t, const sim::Vec3& point) {
  return sim::euler_xyz(t.rotate) * t.scale.cwiseProduct(point - t.pivot) + t.pivot + t.translate;
}

}  // namespace softreel::app
