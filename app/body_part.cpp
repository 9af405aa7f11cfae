#include "app/body_part.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace softreel::app {

bool contains(const assets::Box& box, const sim::Vec3& p) {
  return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
}

std::vector<int> vertices_in(const assets::Box& box, const std::vector<sim::Vec3>& vertices) {
  std::vector<int> inside;
  for (size_t i = 0; i < vertices.size(); ++i)
    if (contains(box, vertices[i])) inside.push_back(static_cast<int>(i));
  return inside;
}

std::string reach_text(const std::vector<sim::Vec3>& vertices) {
  Eigen::AlignedBox3d bounds;
  for (const sim::Vec3& p : vertices) bounds.extend(p);
  return fmt::format("reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) [m]", bounds.min().x(),
                     bounds.min().y(), bounds.min().z(), bounds.max().x(), bounds.max().y(), bounds.max().z());
}

}  // namespace softreel::app
