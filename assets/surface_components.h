#pragma once
// The connected parts of a surface and which of them lie inside which.
#include <Eigen/Geometry>

#include "sim/mesh.h"

namespace softreel::assets {

/// Faces connected by shared vertices.
struct SurfaceComponent {
  std::vector<int> faces;   ///< ascending, not empty
  double volume = 0;        ///< signed, enclosed [m^3]; meaningful where closed
  Eigen::AlignedBox3d box;  ///< [m]
};

/// In the order of their first faces.
std::vector<SurfaceComponent> surface_components(const sim::TriangleMesh& mesh);

/// How often the other components wind around component `i`: 0 outside of all, 1 inside one that faces outwards.
/// Closed components that do not cross. Solid angles after van Oosterom and Strackee (1983).
double winding_of_others(const sim::TriangleMesh& mesh, const std::vector<SurfaceComponent>& components, std::size_t i);

/// How often `faces` of the mesh wind around `point`.
double winding(const sim::TriangleMesh& mesh, const std::vector<int>& faces, const sim::Vec3& point);

}  // namespace softreel::assets
