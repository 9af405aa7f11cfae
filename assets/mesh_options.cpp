#include "assets/mesh_options.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace softreel::assets {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 21> kUnits = {{
    {"m", 1.0},           {"metre", 1.0},       {"meter", 1.0}, {"dm", 0.1},          {"cm", 0.01},
    {"centimetre", 0.01}, {"centimeter", 0.01}, {"mm", 1e-3},   {"millimetre", 1e-3}, {"millimeter", 1e-3},
    {"um", 1e-6},         {"km", 1e3},          {"in", 0.0254}, {"inch", 0.0254},     {"ft", 0.3048},
    {"foot", 0.3048},     {"feet", 0.3048},     {"yd", 0.9144}, {"yard", 0.9144},     {"meters", 1.0},
    {"metres", 1.0},
}};

}  // namespace

std::optional<double> metres_per_unit(std::string_view name) {
  for (const auto& [known, metres] : kUnits) {
    if (known == name) return metres;
  }
  return std::nullopt;
}

std::string_view unit_names() { return "m, dm, cm, mm, um, km, in, ft, yd"; }

Eigen::Matrix3d y_from_up(char up) {
  Eigen::Matrix3d turn;
  switch (up) {
    case 'y':
      return Eigen::Matrix3d::Identity();
    case 'z':
      turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      return turn;
    case 'x':
      turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      return turn;
    default:
      throw std::logic_error("up must be 'x', 'y' or 'z'");
  }
}

double apply_mesh_options(const MeshOptions& options, std::vector<sim::Vec3>& vertices) {
  if (!(options.unit > 0) || !std::isfinite(options.unit)) throw std::logic_error("unit must be positive");
  if (options.size && (!(*options.size > 0) || !std::isfinite(*options.size))) {
    throw std::logic_error("size must be positive");
  }
  double scale = options.unit;
  if (options.size) {
    Eigen::AlignedBox3d box;
    for (const sim::Vec3& p : vertices) box.extend(p);
    const double longest = vertices.empty() ? 0.0 : box.sizes().maxCoeff();
    if (!(longest > 0)) throw std::logic_error("size needs a mesh of some extent");
    scale = *options.size / longest;
  }
  const Eigen::Matrix3d turn = y_from_up(options.up);
  if (scale == 1.0 && options.up == 'y') return scale;  // the file's own bits
  for (sim::Vec3& p : vertices) p = turn * (scale * p);
  return scale;
}

}  // namespace softreel::assets
