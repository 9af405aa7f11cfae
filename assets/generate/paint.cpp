#include "assets/generate/paint.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "assets/atomic_file.h"

namespace softreel::generate {
namespace {

/// Moves p along the surface onto the border of the region.
Vec3 onto_border(const Field& surface, const Field& region, Vec3 p) {
  for (int i = 0; i < 6; ++i) {
    const Vec3 n = gradient(surface, p).normalized();
    Vec3 g = gradient(region, p);
    g -= n * n.dot(g);
    if (g.squaredNorm() < 1e-4) break;
    p = project(surface, p - g * (region(p) / g.squaredNorm()));
  }
  return p;
}

double shortest_edge(const sim::TriangleMesh& mesh, const std::vector<std::vector<int>>& around, std::size_t v) {
  double shortest = 1e9;
  for (const int w : around[v]) {
    shortest = std::min(shortest, (mesh.vertices[static_cast<std::size_t>(w)] - mesh.vertices[v]).norm());
  }
  return shortest;
}

/// After this, no edge runs from inside the region to outside of it without a vertex (side 0) on the border.
std::vector<int> cut_along(sim::TriangleMesh& mesh, const Field& surface, const Field& region) {
  std::vector<std::vector<int>> around(mesh.vertices.size());
  for (const sim::Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) around[static_cast<std::size_t>(t[k])].push_back(t[(k + 1) % 3]);
  }
  std::vector<int> side(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double value = region(mesh.vertices[v]);
    side[v] = value < 0 ? -1 : 1;
    const double reach = 0.35 * shortest_edge(mesh, around, v);
    if (std::abs(value) > reach) continue;
    const Vec3 moved = onto_border(surface, region, mesh.vertices[v]);
    if ((moved - mesh.vertices[v]).norm() > 1.2 * reach) continue;
    mesh.vertices[v] = moved;
    side[v] = 0;
  }
  std::map<std::pair<int, int>, int> cuts;
  const auto cut = [&](int a, int b) {
    const auto [found, fresh] = cuts.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
    if (fresh) {
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(a)], q = mesh.vertices[static_cast<std::size_t>(b)];
      const double u = region(p), w = region(q);
      mesh.vertices.push_back(project(surface, p + u / (u - w) * (q - p)));
      side.push_back(0);
    }
    return found->second;
  };
  std::vector<sim::Triangle> triangles;
  for (sim::Triangle t : mesh.triangles) {
    const auto s = [&](std::size_t k) { return side[static_cast<std::size_t>(t[k % 3])]; };
    int crossed = 0;
    for (std::size_t k = 0; k < 3; ++k) crossed += s(k) * s(k + 1) < 0;
    if (crossed == 0) {
      triangles.push_back(t);
    } else if (crossed == 1) {  // through a corner on the border
      while (s(0) != 0) std::rotate(t.begin(), t.begin() + 1, t.end());
      const int m = cut(t[1], t[2]);
      triangles.push_back({t[0], t[1], m});
      triangles.push_back({t[0], m, t[2]});
    } else {  // one corner alone on its side
      while (s(0) * s(1) >= 0 || s(0) * s(2) >= 0) std::rotate(t.begin(), t.begin() + 1, t.end());
      const int m = cut(t[0], t[1]), n = cut(t[0], t[2]);
      triangles.push_back({t[0], m, n});
      triangles.push_back({m, t[1], t[2]});
      triangles.push_back({m, t[2], n});
    }
  }
  mesh.triangles = std::move(triangles);
  return side;
}

}  // namespace

std::vector<int> apply_paints(sim::TriangleMesh& mesh, const Field& surface, const std::vector<Paint>& paints) {
  for (std::size_t i = 1; i < paints.size(); ++i) cut_along(mesh, surface, paints[i].region);
  std::vector<int> paint_of;
  for (const sim::Triangle& t : mesh.triangles) {
    Vec3 center = Vec3::Zero();
    for (const int v : t) center += mesh.vertices[static_cast<std::size_t>(v)] / 3;
    int paint = 0;
    for (std::size_t i = 1; i < paints.size(); ++i) {
      if (paints[i].region(center) < 0) paint = static_cast<int>(i);
    }
    paint_of.push_back(paint);
  }
  return paint_of;
}

void write_painted_obj(const std::filesystem::path& file, const sim::TriangleMesh& mesh,
                       const std::vector<int>& paint_of, const std::vector<Paint>& paints) {
  const std::string stem = file.stem().string();
  std::string mtl, obj = fmt::format("mtllib {}.mtl\no {}\n", stem, stem);
  auto out = std::back_inserter(obj);
  for (const Vec3& p : mesh.vertices) fmt::format_to(out, "v {:.5f} {:.5f} {:.5f}\n", p.x(), p.y(), p.z());
  for (std::size_t i = 0; i < paints.size(); ++i) {
    const Paint& paint = paints[i];
    // Exponent of the same highlight: roughness^4 = 2 / (exponent + 2).
    fmt::format_to(std::back_inserter(mtl), "newmtl {}\nKd {} {} {}\nKs 0.04 0.04 0.04\nNs {:.1f}\n\n", paint.name,
                   paint.color[0], paint.color[1], paint.color[2], 2 / std::pow(paint.roughness, 4) - 2);
    fmt::format_to(out, "usemtl {}\n", paint.name);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const sim::Triangle& t = mesh.triangles[f];
      if (paint_of[f] == static_cast<int>(i)) fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
  }
  assets::write_file_atomically(file, obj);
  assets::write_file_atomically(std::filesystem::path(file).replace_extension(".mtl"), mtl);
}

}  // namespace softreel::generate
