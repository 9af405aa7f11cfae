// Which render vertices share a smooth normal: decided once, at rest.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "render/surface_mesh.h"

namespace softreel::render {

namespace {

/// For every position the indices of the items that name it, in order (compressed rows).
struct Incidence {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> item;
  std::span<const std::uint32_t> of(std::size_t position) const {
    return std::span(item).subspan(begin[position], begin[position + 1] - begin[position]);
  }
};

Incidence group_by_key(std::size_t key_count, std::span<const std::uint32_t> key) {
  Incidence result;
  result.begin.assign(key_count + 1, 0);
  for (const std::uint32_t k : key) ++result.begin[k + 1];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.item.resize(key.size());
  std::vector<std::uint32_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t i = 0; i < key.size(); ++i) result.item[next[key[i]]++] = static_cast<std::uint32_t>(i);
  return result;
}

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller index leads, so that the outcome does not depend on the order of joining.
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<glm::vec3> unit_face_normals(const SurfaceMesh& mesh, std::span<const glm::vec3> positions) {
  std::vector<glm::vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(positions[mesh.position_of[t.x]]);
    const glm::dvec3 n =
        glm::cross(glm::dvec3(positions[mesh.position_of[t.y]]) - a, glm::dvec3(positions[mesh.position_of[t.z]]) - a);
    const double length = glm::length(n);
    normals.push_back(length > 0 ? glm::vec3(n / length) : glm::vec3(0));
  }
  return normals;
}

/// Corners 3 * triangle + k; joined where a smooth edge runs between their triangles.
UnionFind join_smooth_corners(const SurfaceMesh& mesh, std::span<const glm::vec3> positions, float crease_angle) {
  const std::vector<glm::vec3> face_normal = unit_face_normals(mesh, positions);
  const float smooth_dot = std::cos(glm::radians(std::clamp(crease_angle, 0.0f, 180.0f)));
  const auto corner_position = [&](std::uint32_t corner) {
    return mesh.position_of[mesh.triangles[corner / 3][static_cast<int>(corner % 3)]];
  };
  const auto next_corner = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };

  // Half edge k of a triangle runs from corner k to the next; filed under the smaller of its two positions.
  const auto half_edges = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  std::vector<std::uint32_t> smaller_end(half_edges);
  for (std::uint32_t edge = 0; edge < half_edges; ++edge)
    smaller_end[edge] = std::min(corner_position(edge), corner_position(next_corner(edge)));
  const Incidence edges_at = group_by_key(mesh.position_count, smaller_end);

  UnionFind corners(half_edges);
  const auto join_if_smooth = [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3& na = face_normal[a / 3];
    const glm::vec3& nb = face_normal[b / 3];
    // A triangle without area has no say: it belongs to all its neighbours.
    const bool flat = na == glm::vec3(0) || nb == glm::vec3(0);
    if (!flat && glm::dot(na, nb) < smooth_dot) return;
    const bool same_direction = corner_position(a) == corner_position(b);
    corners.join(a, same_direction ? b : next_corner(b));
    corners.join(next_corner(a), same_direction ? next_corner(b) : b);
  };
  for (std::size_t position = 0; position < mesh.position_count; ++position) {
    const auto edges = edges_at.of(position);
    const auto far_end = [&](std::uint32_t e) { return std::max(corner_position(e), corner_position(next_corner(e))); };
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = i + 1; j < edges.size(); ++j)
        if (far_end(edges[i]) == far_end(edges[j])) join_if_smooth(edges[i], edges[j]);
  }
  return corners;
}

}  // namespace

void group_by_crease(SurfaceMesh& mesh, std::span<const glm::vec3> positions, float crease_angle) {
  UnionFind corners = join_smooth_corners(mesh, positions, crease_angle);
  constexpr std::uint32_t kNone = ~0u;
  mesh.normal_of.assign(mesh.position_of.size(), kNone);

  std::vector<std::uint32_t> group_of_root(3 * mesh.triangles.size(), kNone);
  std::uint32_t group_count = 0;
  std::unordered_map<std::uint64_t, std::uint32_t> copy_of;  // (old vertex, group) -> new vertex
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& group = group_of_root[corners.find(static_cast<std::uint32_t>(3 * triangle + k))];
      if (group == kNone) group = group_count++;
      const std::uint32_t vertex = mesh.triangles[triangle][k];
      if (mesh.normal_of[vertex] == kNone) mesh.normal_of[vertex] = group;
      if (mesh.normal_of[vertex] == group) continue;
      const std::uint64_t key = (static_cast<std::uint64_t>(vertex) << 32) | group;
      const auto [place, fresh] = copy_of.try_emplace(key, static_cast<std::uint32_t>(mesh.position_of.size()));
      if (fresh) {
        mesh.position_of.push_back(std::uint32_t{mesh.position_of[vertex]});
        mesh.normal_of.push_back(group);
        if (!mesh.uv.empty()) mesh.uv.push_back(glm::vec2{mesh.uv[vertex]});
      }
      mesh.triangles[triangle][k] = place->second;
    }
  // Vertices that no triangle uses still need a group of their own.
  for (std::uint32_t& group : mesh.normal_of)
    if (group == kNone) group = group_count++;
}

void group_by_normals(SurfaceMesh& mesh, std::span<const glm::vec3> normals) {
  constexpr float kSameDirection = 0.99985f;  // cos(1 degree)
  const Incidence vertices_at = group_by_key(mesh.position_count, mesh.position_of);
  mesh.normal_of.assign(mesh.position_of.size(), 0);
  std::uint32_t group_count = 0;
  for (std::size_t position = 0; position < mesh.position_count; ++position) {
    const auto vertices = vertices_at.of(position);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const glm::vec3 n = glm::normalize(normals[vertices[i]]);
      std::uint32_t group = group_count;
      for (std::size_t j = 0; j < i && group == group_count; ++j)
        if (glm::dot(n, glm::normalize(normals[vertices[j]])) > kSameDirection) group = mesh.normal_of[vertices[j]];
      mesh.normal_of[vertices[i]] = group;
      if (group == group_count) ++group_count;
    }
  }
}

}  // namespace softreel::render
