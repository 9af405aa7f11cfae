#include "assets/surface_components.h"

#include <cmath>
#include <numbers>

#include "assets/union_find.h"

namespace softreel::assets {

std::vector<SurfaceComponent> surface_components(const sim::TriangleMesh& mesh) {
  UnionFind sets(mesh.vertices.size());
  for (const sim::Triangle& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  std::vector<int> number(mesh.vertices.size(), -1);
  std::vector<SurfaceComponent> components;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const sim::Triangle& t = mesh.triangles[f];
    int& n = number[static_cast<std::size_t>(sets.find(t[0]))];
    if (n < 0) {
      n = static_cast<int>(components.size());
      components.emplace_back();
    }
    SurfaceComponent& c = components[static_cast<std::size_t>(n)];
    const auto p = [&](std::size_t k) -> const sim::Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    if (c.faces.empty()) c.box = Eigen::AlignedBox3d(p(0));
    for (std::size_t k = 0; k < 3; ++k) c.box.extend(p(k));
    // About the component's own corner: far from the origin the terms would cancel.
    const sim::Vec3& o = mesh.vertices[static_cast<std::size_t>(
        mesh.triangles[static_cast<std::size_t>(c.faces.empty() ? static_cast<int>(f) : c.faces.front())][0])];
    c.volume += (p(0) - o).dot((p(1) - o).cross(p(2) - o)) / 6.0;
    c.faces.push_back(static_cast<int>(f));
  }
  return components;
}

double winding(const sim::TriangleMesh& mesh, const std::vector<int>& faces, const sim::Vec3& point) {
  double angle = 0;
  for (const int f : faces) {
    const sim::Triangle& t = mesh.triangles[static_cast<std::size_t>(f)];
    const sim::Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])] - point;
    const sim::Vec3 b = mesh.vertices[static_cast<std::size_t>(t[1])] - point;
    const sim::Vec3 c = mesh.vertices[static_cast<std::size_t>(t[2])] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

double winding_of_others(const sim::TriangleMesh& mesh, const std::vector<SurfaceComponent>& components,
                         std::size_t i) {
  const sim::Vec3& point =
      mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(components[i].faces.front())][0])];
  double total = 0;
  for (std::size_t j = 0; j < components.size(); ++j) {
    if (j != i && components[j].box.contains(components[i].box)) total += winding(mesh, components[j].faces, point);
  }
  return total;
}

}  // namespace softreel::assets
