#include "sim/contact/contact_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace softreel::sim {

ContactSurfaces::ContactSurfaces(const std::vector<SurfaceInput>& inputs, std::span<const SurfacePairRule> rules) {
  for (size_t s = 0; s < inputs.size(); ++s) {
    const SurfaceInput& input = inputs[s];
    ContactSurface surface;
    surface.name = input.name;
    surface.first = vertices();
    surface.first_triangle = static_cast<int>(triangles.size());
    surface.triangle_count = static_cast<int>(input.triangles.size());
    surface.half_thickness = 0.5 * input.thickness;
    surface.friction = input.friction;
    surface.collider = input.first_vertex < 0;
    surface.motion = input.motion;
    std::vector<int> number(input.vertices.size(), -1);
    for (const Triangle& t : input.triangles)
      for (const int v : t) {
        if (v < 0 || static_cast<size_t>(v) >= number.size())
          throw std::invalid_argument("a triangle of surface '" + input.name + "' names a vertex that is not there");
        number[static_cast<size_t>(v)] = 0;
      }
    for (size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = vertices();
      rest.push_back(input.vertices[v]);
      state_vertex.push_back(surface.collider ? -1 : input.first_vertex + static_cast<int>(v));
      surface_of.push_back(static_cast<int>(s));
    }
    surface.count = vertices() - surface.first;
    std::map<std::array<int, 2>, int> edge_number;
    std::vector<bool> stood_for(static_cast<size_t>(surface.count), false);
    for (const Triangle& t : input.triangles) {
      Triangle own;
      std::array<int, 3> own_edges;
      std::uint8_t stands = 0;
      for (size_t k = 0; k < 3; ++k) {
        own[k] = number[static_cast<size_t>(t[k])];
        const auto local = static_cast<size_t>(own[k] - surface.first);
        if (!stood_for[local]) stands |= static_cast<std::uint8_t>(1 << k);
        stood_for[local] = true;
      }
      for (size_t k = 0; k < 3; ++k) {
        const std::array<int, 2> edge = {std::min(own[k], own[(k + 1) % 3]), std::max(own[k], own[(k + 1) % 3])};
        const auto [it, fresh] = edge_number.try_emplace(edge, static_cast<int>(edges.size()));
        if (fresh) {
          edges.push_back(edge);
          stands |= static_cast<std::uint8_t>(8 << k);
        }
        own_edges[k] = it->second;
      }
      triangles.push_back(own);
      triangle_edges.push_back(own_edges);
      stands_for.push_back(stands);
    }
    surfaces.push_back(std::move(surface));
  }
  for (int a = 0; a < static_cast<int>(surfaces.size()); ++a)
    for (int b = a; b < static_cast<int>(surfaces.size()); ++b) {
      const SurfaceInput &first = inputs[static_cast<size_t>(a)], &second = inputs[static_cast<size_t>(b)];
      bool touch = a == b ? first.self : first.others && second.others;
      SurfacePair pair{a, b, std::sqrt(first.friction * second.friction), 0.5 * (first.thickness + second.thickness),
                       a == b};
      for (const SurfacePairRule& rule : rules) {
        if (std::minmax(rule.a, rule.b) != std::minmax(a, b)) continue;
        touch = touch && rule.touch;
        if (rule.touch && a == b) touch = true;
        if (rule.friction >= 0) pair.friction = rule.friction;
        if (rule.thickness >= 0) pair.offset = rule.thickness;
        pair.close_at_rest = pair.close_at_rest || rule.tied;
      }
      const bool scripted = surfaces[static_cast<size_t>(a)].collider && surfaces[static_cast<size_t>(b)].collider;
      if (touch && !scripted) pairs.push_back(pair);
    }
}

bool ContactSurfaces::colliders_move(double from, double to) const {
  return std::any_of(surfaces.begin(), surfaces.end(),
                     [&](const ContactSurface& s) { return s.collider && s.motion.moves(from, to); });
}

ContactSurfaces::ColliderPath ContactSurfaces::collider_path(double t_from, double t_to) const {
  ColliderPath path;
  for (const ContactSurface& s : surfaces) {
    if (!s.collider) continue;
    const Eigen::Isometry3d from = s.motion.pose(t_from), to = s.motion.pose(t_to);
    for (int v = s.first; v < s.first + s.count; ++v) {
      path.from.push_back(from * rest[static_cast<size_t>(v)]);
      path.to.push_back(to * rest[static_cast<size_t>(v)]);
    }
  }
  return path;
}

void ContactSurfaces::gather(const Eigen::VectorXd& x, const ColliderPath& path, double progress,
                             std::vector<Vec3>& positions) const {
  positions.resize(rest.size());
  size_t scripted = 0;
  for (size_t v = 0; v < rest.size(); ++v) {
    if (state_vertex[v] >= 0) {
      positions[v] = x.segment<3>(3 * state_vertex[v]);
    } else {
      positions[v] = path.from[scripted] + progress * (path.to[scripted] - path.from[scripted]);
      ++scripted;
    }
  }
}

void ContactSurfaces::gather_move(const Eigen::VectorXd& dx, const ColliderPath& path, double advance,
                                  std::vector<Vec3>& moves) const {
  moves.resize(rest.size());
  size_t scripted = 0;
  for (size_t v = 0; v < rest.size(); ++v) {
    if (state_vertex[v] >= 0) {
      moves[v] = dx.segment<3>(3 * state_vertex[v]);
    } else {
      moves[v] = advance * (path.to[scripted] - path.from[scripted]);
      ++scripted;
    }
  }
}

}  // namespace softreel::sim
