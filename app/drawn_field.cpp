#include "app/drawn_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/convert.h"
#include "assets/scene_names.h"
#include "render/color_map.h"

namespace softreel::app {

FieldSurface::FieldSurface(const assets::Field& field, const ClothShape& shape)
    : height_(field.height), rest_(shape.rest.vertices) {
  if (height_ == 0) return;
  normals_.assign(rest_.size(), sim::Vec3::Zero());
  for (const sim::Triangle& t : shape.rest.triangles) {
    const auto at = [&](size_t corner) { return rest_[static_cast<size_t>(t[corner])]; };
    const sim::Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
    for (int v : t) normals_[static_cast<size_t>(v)] += normal;
  }
  for (sim::Vec3& n : normals_) n.normalize();
}

std::vector<sim::Vec3> FieldSurface::points(const Eigen::VectorXd& value) const {
  std::vector<sim::Vec3> points = rest_;
  for (size_t i = 0; i < normals_.size(); ++i) points[i] += height_ * value(static_cast<Eigen::Index>(i)) * normals_[i];
  return points;
}

std::vector<glm::vec3> FieldSurface::positions(const Eigen::VectorXd& value) const {
  std::vector<glm::vec3> positions;
  positions.reserve(rest_.size());
  for (const sim::Vec3& p : points(value)) positions.push_back(to_glm(p));
  return positions;
}

void FieldRange::add(const Eigen::VectorXd& value) {
  if (value.size() == 0) return;
  low = std::min(low, value.minCoeff());
  high = std::max(high, value.maxCoeff());
}

std::array<double, 2> color_range(const std::optional<std::array<double, 2>>& range, assets::ColorMap map,
                                  const FieldRange& covered) {
  if (range) return *range;
  double low = covered.low, high = covered.high;
  if (!(low <= high)) return {0, 1};
  if (map == assets::ColorMap::kCoolwarm) {
    high = std::max(std::abs(low), std::abs(high));
    low = -high;
  }
  // One value alone is in the middle.
  const double least = std::max(1e-9 * std::max(std::abs(low), std::abs(high)), 1e-300);
  if (high - low < least) {
    const double half = low == high && low == 0 ? 1 : std::max(0.5 * std::abs(low), least);
    return {low - half, high + half};
  }
  return {low, high};
}

std::vector<float> map_places(const Eigen::VectorXd& value, const std::array<double, 2>& range) {
  std::vector<float> places;
  places.reserve(static_cast<size_t>(value.size()));
  for (double v : value) places.push_back(static_cast<float>((v - range[0]) / (range[1] - range[0])));
  return places;
}

render::Look field_look(const assets::Field& field) {
  render::Look look;
  look.two_sided = true;
  look.color_map = render::color_map_index(assets::name_of(field.colormap));
  look.shading = static_cast<float>(field.shading.value_or(field.height != 0 ? 0.5 : 0.0));
  return look;
}

render::ColorBar color_bar(const assets::Field& field, const std::array<double, 2>& range) {
  return {render::color_map_index(assets::name_of(field.colormap)), range[0], range[1], field.label};
}

}  // namespace softreel::app
