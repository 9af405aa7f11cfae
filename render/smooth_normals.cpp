#include "render/smooth_normals.h"

#include <algorithm>
#include <cmath>

namespace softreel::render {

std::size_t normal_group_count(const SurfaceMesh& mesh) {
  if (mesh.normal_of.empty()) return mesh.position_count;
  return static_cast<std::size_t>(*std::max_element(mesh.normal_of.begin(), mesh.normal_of.end())) + 1;
}

void compute_smooth_normals(const SurfaceMesh& mesh, std::span<const glm::vec3> positions,
                            std::span<glm::vec3> normals) {
  const std::span<const std::uint32_t> group_of = mesh.normal_of.empty() ? mesh.position_of : mesh.normal_of;
  std::fill(normals.begin(), normals.end(), glm::vec3(0));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3& a = positions[mesh.position_of[t.x]];
    const glm::vec3& b = positions[mesh.position_of[t.y]];
    const glm::vec3& c = positions[mesh.position_of[t.z]];
    const glm::vec3 ab = b - a;
    const glm::vec3 bc = c - b;
    const glm::vec3 ca = a - c;
    // n / (|e1|^2 |e2|^2): |n| already is |e1| |e2| sin(angle). The factor |bc|^2 |ca|^2 |ab|^2 makes one division of
    // three.
    const float ab2 = glm::dot(ab, ab);
    const float bc2 = glm::dot(bc, bc);
    const float ca2 = glm::dot(ca, ca);
    const float product = ab2 * bc2 * ca2;
    if (!(product > 0) || !std::isfinite(product)) continue;
    const glm::vec3 n = glm::cross(ab, -ca) / product;
    normals[group_of[t.x]] += n * bc2;
    normals[group_of[t.y]] += n * ca2;
    normals[group_of[t.z]] += n * ab2;
  }
  for (glm::vec3& n : normals) {
    const float length = glm::length(n);
    n = length > 0 && std::isfinite(length) ? n / length : glm::vec3(0, 1, 0);
  }
}

}  // namespace softreel::render
