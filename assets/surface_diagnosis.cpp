#include "assets/surface_diagnosis.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "assets/crossing_pairs.h"
#include "assets/exact_predicates.h"
#include "assets/surface_components.h"
#include "assets/union_find.h"

namespace softreel::assets {
namespace {

/// A face's side a -> b, stored with the lower index first.
struct Side {
  int low, high;
  int face;
  bool forward;  // runs from low to high
};

std::vector<Side> sorted_sides(const sim::TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::tie(x.low, x.high, x.face) < std::tie(y.low, y.high, y.face);
  });
  return sides;
}

void note(Defect& defect, const sim::Vec3& where) {
  ++defect.count;
  if (defect.where.size() < kDefectPlaces) defect.where.push_back(where);
}

class Diagnosis {
 public:
  explicit Diagnosis(const sim::TriangleMesh& mesh) : mesh_(mesh), sides_(sorted_sides(mesh)) {}

  SurfaceDiagnosis run(int max_crossings) {
    faces();
    edges();
    vertices();
    for (const auto& [a, b] : crossing_pairs(mesh_, static_cast<std::size_t>(std::max(0, max_crossings)))) {
      note(d_.crossings, (center(a) + center(b)) / 2);
    }
    orientation();
    return d_;
  }

 private:
  const sim::Vec3& at(int v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  const sim::Triangle& face(int f) const { return mesh_.triangles[static_cast<std::size_t>(f)]; }
  sim::Vec3 center(int f) const { return (at(face(f)[0]) + at(face(f)[1]) + at(face(f)[2])) / 3.0; }

  void faces() {
    std::map<sim::Triangle, int> seen;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const int f = static_cast<int>(i);
      sim::Triangle key = face(f);
      const sim::Vec3 &a = at(key[0]), &b = at(key[1]), &c = at(key[2]);
      d_.area += (b - a).cross(c - a).norm() / 2;
      if (is_flat(a, b, c)) note(d_.zero_area, center(f));
      std::sort(key.begin(), key.end());
      if (!seen.emplace(key, f).second) note(d_.duplicates, center(f));
    }
  }

  void edges() {
    UnionFind holes(mesh_.vertices.size());
    std::vector<int> on_hole;
    for (std::size_t i = 0; i < sides_.size();) {
      std::size_t j = i;
      while (j < sides_.size() && sides_[j].low == sides_[i].low && sides_[j].high == sides_[i].high) ++j;
      const sim::Vec3 middle = (at(sides_[i].low) + at(sides_[i].high)) / 2;
      if (j - i == 1) {
        note(d_.open_edges, middle);
        holes.join(sides_[i].low, sides_[i].high);
        on_hole.push_back(sides_[i].low);
      } else if (j - i > 2) {
        note(d_.non_manifold_edges, middle);
      } else if (sides_[i].forward == sides_[i + 1].forward) {
        note(d_.flipped_edges, middle);
      }
      i = j;
    }
    for (int& v : on_hole) v = holes.find(v);
    std::sort(on_hole.begin(), on_hole.end());
    d_.boundary_loops = static_cast<int>(std::distance(on_hole.begin(), std::unique(on_hole.begin(), on_hole.end())));
  }

  /// The faces around a vertex, joined across the edges that leave it, must be one fan.
  void vertices() {
    UnionFind corners(3 * mesh_.triangles.size());
    const auto corner = [&](int f, int v) {
      const auto k = std::find(face(f).begin(), face(f).end(), v) - face(f).begin();
      return 3 * f + static_cast<int>(k);
    };
    for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
      const Side &s = sides_[i], &t = sides_[i + 1];
      if (s.low != t.low || s.high != t.high) continue;
      corners.join(corner(s.face, s.low), corner(t.face, s.low));
      corners.join(corner(s.face, s.high), corner(t.face, s.high));
    }
    std::vector<int> fans(mesh_.vertices.size(), 0);
    for (std::size_t i = 0; i < 3 * mesh_.triangles.size(); ++i) {
      if (corners.find(static_cast<int>(i)) == static_cast<int>(i)) {
        ++fans[static_cast<std::size_t>(mesh_.triangles[i / 3][i % 3])];
      }
    }
    for (std::size_t v = 0; v < fans.size(); ++v) {
      if (fans[v] == 0) note(d_.unused_vertices, mesh_.vertices[v]);
      if (fans[v] > 1) note(d_.non_manifold_vertices, mesh_.vertices[v]);
    }
  }

  void orientation() {
    const std::vector<SurfaceComponent> components = surface_components(mesh_);
    d_.components = static_cast<int>(components.size());
    for (const SurfaceComponent& c : components) d_.volume += c.volume;
    if (d_.open_edges.count + d_.non_manifold_edges.count + d_.flipped_edges.count > 0) return;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const SurfaceComponent& c = components[i];
      const sim::Vec3& p = at(face(c.faces.front())[0]);
      const bool inside = winding_of_others(mesh_, components, i) > 0.5;
      if (c.volume < 0 && !inside) note(d_.inside_out, p);
      if (c.volume > 0 && inside) note(d_.nested, p);
    }
  }

  const sim::TriangleMesh& mesh_;
  std::vector<Side> sides_;
  SurfaceDiagnosis d_;
};

}  // namespace

bool SurfaceDiagnosis::bounds_solid() const {
  const int defects = open_edges.count + non_manifold_edges.count + non_manifold_vertices.count + flipped_edges.count +
                      inside_out.count + nested.count + crossings.count + zero_area.count + duplicates.count +
                      unused_vertices.count;
  return defects == 0 && components > 0;
}

SurfaceDiagnosis diagnose_surface(const sim::TriangleMesh& mesh, int max_crossings) {
  return Diagnosis(mesh).run(max_crossings);
}

}  // namespace softreel::assets
