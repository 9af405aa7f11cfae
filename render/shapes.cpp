// Collider shapes as surface meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/surface_mesh.h"

namespace softreel::render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

void add_vertex(SurfaceMesh& mesh, std::uint32_t position, const glm::vec2& uv) {
  mesh.position_of.push_back(position);
  mesh.normal_of.push_back(position);
  mesh.uv.push_back(uv);
}

/// Surface of revolution about y. `profile`: (radius, y) from below the upper pole to above the lower one; the poles
/// themselves at `top` and `bottom`. Positions are welded along the seam, texture coordinates are not.
Shape revolve(const std::vector<glm::vec2>& profile, float top, float bottom, int segments) {
  Shape shape;
  SurfaceMesh& mesh = shape.mesh;
  const auto n = static_cast<std::uint32_t>(segments);
  const auto rings = static_cast<std::uint32_t>(profile.size());
  const float height = top - bottom;

  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t s = 0; s < n; ++s) {
      const float angle = 2 * kPi * static_cast<float>(s) / static_cast<float>(n);
      shape.positions.emplace_back(profile[ring].x * std::cos(angle), profile[ring].y,
                                   -profile[ring].x * std::sin(angle));
    }
    for (std::uint32_t s = 0; s <= n; ++s)
      add_vertex(mesh, ring * n + s % n,
                 {static_cast<float>(s) / static_cast<float>(n), (profile[ring].y - bottom) / height});
  }
  const auto top_position = static_cast<std::uint32_t>(shape.positions.size());
  shape.positions.emplace_back(0, top, 0);
  shape.positions.emplace_back(0, bottom, 0);
  mesh.position_count = shape.positions.size();

  const auto at = [&](std::uint32_t ring, std::uint32_t s) { return ring * (n + 1) + s; };
  for (std::uint32_t s = 0; s < n; ++s) {
    const float u = (static_cast<float>(s) + 0.5f) / static_cast<float>(n);
    const auto pole = static_cast<std::uint32_t>(mesh.position_of.size());
    add_vertex(mesh, top_position, {u, 1});
    add_vertex(mesh, top_position + 1, {u, 0});
    mesh.triangles.emplace_back(pole, at(0, s), at(0, s + 1));
    mesh.triangles.emplace_back(pole + 1, at(rings - 1, s + 1), at(rings - 1, s));
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t s = 0; s < n; ++s) {
      mesh.triangles.emplace_back(at(ring, s), at(ring + 1, s), at(ring + 1, s + 1));
      mesh.triangles.emplace_back(at(ring, s), at(ring + 1, s + 1), at(ring, s + 1));
    }
  return shape;
}

}  // namespace

Shape make_plane(float size_x, float size_z, int cells) {
  Shape shape;
  SurfaceMesh& mesh = shape.mesh;
  const auto n = static_cast<std::uint32_t>(std::max(cells, 1));
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const glm::vec2 uv(static_cast<float>(i) / static_cast<float>(n), static_cast<float>(j) / static_cast<float>(n));
      add_vertex(mesh, static_cast<std::uint32_t>(shape.positions.size()), {uv.x, 1 - uv.y});
      shape.positions.emplace_back((uv.x - 0.5f) * size_x, 0, (uv.y - 0.5f) * size_z);
    }
  mesh.position_count = shape.positions.size();
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      const std::uint32_t below = a + n + 1;
      mesh.triangles.emplace_back(a, below, below + 1);
      mesh.triangles.emplace_back(a, below + 1, a + 1);
    }
  return shape;
}

Shape make_sphere(float radius, int segments) {
  const int around = std::max(segments, 6);
  const int rings = around / 2;
  std::vector<glm::vec2> profile;
  for (int i = 1; i < rings; ++i) {
    const float angle = kPi * static_cast<float>(i) / static_cast<float>(rings);
    profile.emplace_back(radius * std::sin(angle), radius * std::cos(angle));
  }
  return revolve(profile, radius, -radius, around);
}

Shape make_capsule(float radius, float height, int segments) {
  const int around = std::max(segments, 8);
  const int rings = around / 4;
  std::vector<glm::vec2> profile;
  for (int i = 1; i <= rings; ++i) {
    const float angle = 0.5f * kPi * static_cast<float>(i) / static_cast<float>(rings);
    profile.emplace_back(radius * std::sin(angle), 0.5f * height + radius * std::cos(angle));
  }
  const std::size_t upper = profile.size();
  for (std::size_t i = upper; i-- > 0;) {
    if (i + 1 == upper && height <= 0) continue;  // one ring at the waist is enough for a sphere
    profile.emplace_back(profile[i].x, -profile[i].y);
  }
  return revolve(profile, 0.5f * height + radius, -0.5f * height - radius, around);
}

Shape make_box(const glm::vec3& size) {
  Shape shape;
  SurfaceMesh& mesh = shape.mesh;
  for (int corner = 0; corner < 8; ++corner)
    shape.positions.push_back(
        0.5f * size * glm::vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1));
  mesh.position_count = 8;
  // Corners of each face, counter-clockwise from outside, from the lower left.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}, {4, 5, 7, 6}, {1, 0, 2, 3}}};
  constexpr std::array<glm::vec2, 4> kUv{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::uint32_t face = 0; face < 6; ++face) {
    const auto first = static_cast<std::uint32_t>(mesh.position_of.size());
    for (std::size_t k = 0; k < 4; ++k) {
      mesh.position_of.push_back(kFaces[face][k]);
      mesh.normal_of.push_back(face);
      mesh.uv.push_back(kUv[k]);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  return shape;
}

}  // namespace softreel::render
