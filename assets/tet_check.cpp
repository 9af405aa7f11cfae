#include "assets/tet_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "assets/drop_unused.h"
#include "assets/surface_components.h"

namespace softreel::assets {
namespace {

constexpr double kVolumeTolerance = 1e-6;

/// Turns every tet to positive volume; false when one has none.
bool orient(const std::vector<sim::Vec3>& vertices, std::vector<sim::Tet>& tets) {
  for (sim::Tet& t : tets) {
    const auto p = [&](std::size_t k) -> const sim::Vec3& { return vertices[static_cast<std::size_t>(t[k])]; };
    const double volume = sim::tet_volume(p(0), p(1), p(2), p(3));
    if (!(std::abs(volume) > 0)) return false;
    if (volume < 0) std::swap(t[2], t[3]);
  }
  return true;
}

bool in_range(const TetgenReply& reply) {
  const int n = static_cast<int>(reply.vertices.size());
  for (const sim::Tet& t : reply.tets) {
    for (const int v : t) {
      if (v < 0 || v >= n) return false;
    }
  }
  return reply.regions.size() == reply.tets.size();
}

/// TetGen fills cavities as regions of their own: those the surface does not wind around are cleared.
void clear_cavities(const sim::TriangleMesh& surface, TetgenReply& reply) {
  std::vector<int> faces(surface.triangles.size());
  std::iota(faces.begin(), faces.end(), 0);
  std::map<int, bool> solid;
  std::vector<sim::Tet> kept;
  for (std::size_t i = 0; i < reply.tets.size(); ++i) {
    const auto [at, fresh] = solid.try_emplace(reply.regions[i], true);
    if (fresh) {
      sim::Vec3 center = sim::Vec3::Zero();
      for (const int v : reply.tets[i]) center += reply.vertices[static_cast<std::size_t>(v)] / 4;
      at->second = winding(surface, faces, center) > 0.5;
    }
    if (at->second) kept.push_back(reply.tets[i]);
  }
  reply.tets = std::move(kept);
}

sim::Triangle turned(sim::Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::vector<sim::Triangle> sorted_faces(const std::vector<sim::Triangle>& triangles) {
  std::vector<sim::Triangle> faces(triangles.size());
  std::transform(triangles.begin(), triangles.end(), faces.begin(), turned);
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

std::string accept_tets(const sim::TriangleMesh& surface, TetgenReply reply, double volume, sim::TetMesh& mesh) {
  if (reply.tets.empty()) return "TetGen gave no tetrahedra";
  if (reply.vertices.size() < surface.vertices.size() || !in_range(reply)) return "TetGen gave a broken mesh";
  // The scaling by a power of two went there and back exactly: anything else means that points were renumbered.
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    if (reply.vertices[i] != surface.vertices[i]) return "TetGen moved or renumbered the points of the surface";
  }
  if (!orient(reply.vertices, reply.tets)) return "TetGen gave tetrahedra without volume";
  clear_cavities(surface, reply);
  mesh = {std::move(reply.vertices), std::move(reply.tets)};
  if (sorted_faces(sim::boundary_triangles(mesh)) != sorted_faces(surface.triangles)) {
    return "TetGen did not keep its faces";
  }
  drop_unused(mesh.vertices, mesh.tets);  // every surface vertex is in use: the first ones stay where they are
  double filled = 0;
  for (const sim::Tet& t : mesh.tets) {
    const auto p = [&](std::size_t k) -> const sim::Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    filled += sim::tet_volume(p(0), p(1), p(2), p(3));
  }
  if (!(std::abs(filled - volume) <= kVolumeTolerance * volume)) {
    return fmt::format("TetGen filled {:.9g} m^3 where it encloses {:.9g} m^3", filled, volume);
  }
  return "";
}

}  // namespace softreel::assets
