#include <fmt/format.h>
#include <Eigen/LU>

#include "app/forecast_warnings.h"

namespace softreel::app {
namespace {

/// Is p in one of the tetrahedra?
bool holds(const sim::TetMesh& mesh, const sim::Vec3& p) {
  for (const auto& tet : mesh.tets) {
    const auto corner = [&](size_t k) -> const sim::Vec3& { return mesh.vertices[static_cast<size_t>(tet[k])]; };
    Eigen::Matrix3d edges;
    for (size_t k = 0; k < 3; ++k) edges.col(static_cast<Eigen::Index>(k)) = corner(k + 1) - corner(0);
    const sim::Vec3 weights = edges.inverse() * (p - corner(0));
    if (weights.minCoeff() > 0 && weights.sum() < 1) return true;
  }
  return false;
}

}  // namespace

void warn_of_lights(const assets::Scene& scene, const Shapes& shapes, std::vector<std::string>& warnings) {
  for (size_t l = 0; l < scene.lights.size(); ++l) {
    const assets::Light& light = scene.lights[l];
    if (light.kind == assets::LightKind::kSun || !light.position) continue;
    for (size_t i = 0; i < scene.soft.size(); ++i)
      if (holds(shapes.soft[i].rest, *light.position))
        warnings.push_back(
            fmt::format("light {} stands inside '{}' at the start, which casts no whole shadow around it: move the "
                        "light out (light.{}.position)",
                        l + 1, scene.soft[i].name, l + 1));
  }
}

}  // namespace softreel::app
