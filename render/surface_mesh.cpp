#include "render/surface_mesh.h"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

namespace softreel::render {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("surface mesh: " + what); }

void check_normal_groups(const SurfaceMesh& mesh) {
  std::vector<bool> used(mesh.normal_of.size(), false);
  std::size_t groups = 0;
  for (const std::uint32_t group : mesh.normal_of) {
    if (group >= used.size()) refuse(fmt::format("normal group {} of at most {}", group, used.size()));
    if (!used[group]) ++groups;
    used[group] = true;
  }
  for (std::size_t group = 0; group < groups; ++group)
    if (!used[group]) refuse(fmt::format("normal group {} is named by no vertex", group));
}

}  // namespace

SurfaceMesh mesh_from_triangles(std::size_t position_count, std::span<const glm::uvec3> triangles) {
  SurfaceMesh mesh;
  mesh.position_count = position_count;
  mesh.position_of.resize(position_count);
  std::iota(mesh.position_of.begin(), mesh.position_of.end(), 0u);
  mesh.normal_of = mesh.position_of;
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

void check_mesh(const SurfaceMesh& mesh, std::size_t look_count) {
  const std::size_t vertices = mesh.position_of.size();
  if (look_count == 0) refuse("no look");
  if (vertices > 0xfffffffeu || mesh.position_count > 0xfffffffeu) refuse("more vertices than 32 bits can number");
  for (const std::uint32_t position : mesh.position_of)
    if (position >= mesh.position_count) refuse(fmt::format("position {} of {}", position, mesh.position_count));
  if (!mesh.normal_of.empty() && mesh.normal_of.size() != vertices)
    refuse(fmt::format("{} normal groups for {} vertices", mesh.normal_of.size(), vertices));
  check_normal_groups(mesh);
  if (!mesh.uv.empty() && mesh.uv.size() != vertices)
    refuse(fmt::format("{} texture coordinates for {} vertices", mesh.uv.size(), vertices));
  if (!mesh.rest.empty() && mesh.rest.size() != vertices)
    refuse(fmt::format("{} places at rest for {} vertices", mesh.rest.size(), vertices));
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (triangle[corner] >= vertices) refuse(fmt::format("vertex {} of {}", triangle[corner], vertices));
  for (const MeshPart& part : mesh.parts) {
    if (part.first_triangle > mesh.triangles.size() ||
        part.triangle_count > mesh.triangles.size() - part.first_triangle)
      refuse(fmt::format("a part of {} triangles from {} on, of {}", part.triangle_count, part.first_triangle,
                         mesh.triangles.size()));
    if (part.look >= look_count) refuse(fmt::format("look {} of {}", part.look, look_count));
  }
}

}  // namespace softreel::render
