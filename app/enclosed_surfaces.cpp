#include "app/enclosed_surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace softreel::app {
namespace {

using sim::Vec3;

std::span<const sim::Triangle> triangles_of(const sim::ContactSurfaces& surfaces, const sim::ContactSurface& s) {
  return std::span(surfaces.triangles)
      .subspan(static_cast<size_t>(s.first_triangle), static_cast<size_t>(s.triangle_count));
}

/// How often a closed surface winds around p: the sum of the solid angles of its triangles (Van Oosterom, Strackee
/// 1983, "The solid angle of a plane triangle"). 1 inside, 0 outside, in between on it.
double winding(std::span<const sim::Triangle> triangles, std::span<const Vec3> x, const Vec3& p) {
  double sum = 0;
  for (const sim::Triangle& t : triangles) {
    const Vec3 a = x[static_cast<size_t>(t[0])] - p, b = x[static_cast<size_t>(t[1])] - p,
               c = x[static_cast<size_t>(t[2])] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(sum) / (4 * std::numbers::pi);
}

/// Per vertex of a surface: the first vertex of its connected part.
std::vector<int> parts_of(const sim::ContactSurfaces& surfaces, const sim::ContactSurface& s) {
  std::vector<int> parent(static_cast<size_t>(s.count));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[static_cast<size_t>(v)] != v) {
      int& up = parent[static_cast<size_t>(v)];
      v = up = parent[static_cast<size_t>(up)];
    }
    return v;
  };
  for (const sim::Triangle& t : triangles_of(surfaces, s))
    for (const int v : {t[1], t[2]}) {
      const int a = root(t[0] - s.first), b = root(v - s.first);
      parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    }
  std::vector<int> parts(parent.size());
  for (int v = 0; v < s.count; ++v) parts[static_cast<size_t>(v)] = root(v);
  return parts;
}

Eigen::AlignedBox3d box_of(const sim::ContactSurface& s, std::span<const Vec3> x) {
  Eigen::AlignedBox3d box;
  for (int v = s.first; v < s.first + s.count; ++v) box.extend(x[static_cast<size_t>(v)]);
  return box;
}

/// Nothing crosses, so a part is inside or outside as a whole: its first vertex that is clearly one of the two decides.
bool any_part_inside(const sim::ContactSurfaces& surfaces, const sim::ContactSurface& s,
                     const sim::ContactSurface& outer, std::span<const Vec3> x) {
  constexpr double kOn = 0.25;  // winding numbers of points on a face are 1/2, to rounding
  const Eigen::AlignedBox3d box = box_of(outer, x);
  if (!box.intersects(box_of(s, x))) return false;
  const std::vector<int> parts = parts_of(surfaces, s);
  std::vector<std::uint8_t> decided(parts.size(), 0);
  for (size_t v = 0; v < parts.size(); ++v) {
    const auto part = static_cast<size_t>(parts[v]);
    if (decided[part]) continue;
    const Vec3& p = x[static_cast<size_t>(s.first) + v];
    const double w = box.contains(p) ? winding(triangles_of(surfaces, outer), x, p) : 0;
    if (w > 1 - kOn) return true;
    decided[part] = w < kOn;
  }
  return false;
}

}  // namespace

std::vector<std::pair<int, int>> enclosed(const sim::ContactSurfaces& surfaces, std::span<const Vec3> x,
                                          std::span<const std::uint8_t> solid) {
  std::vector<std::pair<int, int>> result;
  for (const sim::SurfacePair& pair : surfaces.pairs) {
    if (pair.a == pair.b) continue;
    for (const auto& [outer, inner] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)})
      if (solid[static_cast<size_t>(outer)] && any_part_inside(surfaces, surfaces.surfaces[static_cast<size_t>(inner)],
                                                               surfaces.surfaces[static_cast<size_t>(outer)], x))
        result.emplace_back(outer, inner);
  }
  return result;
}

}  // namespace softreel::app
