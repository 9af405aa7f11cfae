#include "app/touching_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>

#include "app/enclosed_surfaces.h"
#include "app/way_apart.h"
#include "app/world.h"
#include "assets/crossing_pairs.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

using sim::Vec3;

template <class Visit>
void for_each_touching_body(const assets::Scene& scene, const Visit& visit) {
  for (size_t i = 0; i < scene.soft.size(); ++i) visit(fmt::format("soft.{}", i + 1), scene.soft[i]);
  for (size_t i = 0; i < scene.cloth.size(); ++i) visit(fmt::format("cloth.{}", i + 1), scene.cloth[i]);
}

std::vector<Vec3> positions_of(const sim::ContactSurfaces& surfaces, const Eigen::VectorXd& x, double t) {
  std::vector<Vec3> result;
  surfaces.gather(x, surfaces.collider_path(t, t), 0, result);
  return result;
}

[[noreturn]] void refuse(const assets::Scene& scene, const std::string& why) {
  throw assets::UserError(assets::ErrorKind::kUsage, scene.file.string(), why);
}

std::string list_of(const sim::ContactSurfaces& surfaces, const std::vector<Crossing>& found) {
  std::string list;
  for (const Crossing& c : found) {
    const auto name = [&](int s) { return surfaces.surfaces[static_cast<size_t>(s)].name; };
    if (c.pairs == 0) {
      list += fmt::format("{}'{}' inside '{}'", list.empty() ? "" : ", ", name(c.second), name(c.first));
      continue;
    }
    list += fmt::format("{}'{}' and {} ({} pair{} of triangles)", list.empty() ? "" : ", ", name(c.first),
                        c.first == c.second ? "itself" : fmt::format("'{}'", name(c.second)), c.pairs,
                        c.pairs == 1 ? "" : "s");
  }
  return list;
}

/// Surfaces and bodies of the state they belong to, while bodies are moved.
class Separation {
 public:
  Separation(const sim::ContactSurfaces& surfaces, sim::Model& model) : surfaces_(surfaces), model_(model) {}

  /// The body that surface s belongs to; null: a collider, or a body that pins hold.
  const sim::BodyRange* movable(int s) const {
    const sim::ContactSurface& surface = surfaces_.surfaces[static_cast<size_t>(s)];
    if (surface.collider || surface.count == 0) return nullptr;
    const int vertex = surfaces_.state_vertex[static_cast<size_t>(surface.first)];
    for (const sim::BodyRange& body : model_.bodies) {
      if (vertex < body.first || vertex >= body.first + body.count) continue;
      const bool pinned = std::any_of(model_.pins.begin(), model_.pins.end(), [&](const sim::Pin& pin) {
        return std::any_of(pin.vertices.begin(), pin.vertices.end(),
                           [&](int v) { return v >= body.first && v < body.first + body.count; });
      });
      return pinned ? nullptr : &body;
    }
    return nullptr;
  }

  /// The shortest way that is found to take surface `own` clear of `other`: along the normals of triangles that cross,
  /// the line between their middles, or an axis.
  Vec3 way_out(int own, int other, double gap) const {
    const std::vector<Vec3> x = positions_of(surfaces_, model_.x0, 0);
    const auto points = [&](int s) {
      const sim::ContactSurface& surface = surfaces_.surfaces[static_cast<size_t>(s)];
      return std::span(x).subspan(static_cast<size_t>(surface.first), static_cast<size_t>(surface.count));
    };
    const auto middle = [](std::span<const Vec3> of) {
      return Vec3(std::accumulate(of.begin(), of.end(), Vec3(Vec3::Zero())) / static_cast<double>(of.size()));
    };
    std::vector<Vec3> directions{middle(points(own)) - middle(points(other))};
    const auto belongs = [&](int triangle, int s) {
      const sim::ContactSurface& surface = surfaces_.surfaces[static_cast<size_t>(s)];
      return triangle >= surface.first_triangle && triangle < surface.first_triangle + surface.triangle_count;
    };
    const auto wanted = [&](int t1, int t2) {
      return (belongs(t1, own) && belongs(t2, other)) || (belongs(t1, other) && belongs(t2, own));
    };
    constexpr size_t kMost = 100;  // enough to know how the two lie
    for (const auto& [t1, t2] : assets::crossing_pairs({x, surfaces_.triangles}, kMost, wanted))
      for (const int t : {t1, t2}) {
        const sim::Triangle& v = surfaces_.triangles[static_cast<size_t>(t)];
        const auto corner = [&](size_t i) { return x[static_cast<size_t>(v[i])]; };
        directions.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)));
      }
    return way_apart(points(own), points(other), directions, gap);
  }

  void move(const sim::BodyRange& body, const Vec3& by) {
    for (int v = body.first; v < body.first + body.count; ++v) model_.x0.segment<3>(3 * v) += by;
  }

 private:
  const sim::ContactSurfaces& surfaces_;
  sim::Model& model_;
};

}  // namespace

void add_touching_surfaces(const assets::Scene& scene, const Shapes& shapes, const std::vector<PlacedBody>& bodies,
                           sim::ModelBuilder& builder) {
  std::vector<sim::SurfaceInput> surfaces;
  std::map<std::string, int> number;  // by place
  for_each_touching_body(scene, [&](const std::string& place, const assets::Body& body) {
    const PlacedBody& placed =
        *std::find_if(bodies.begin(), bodies.end(), [&](const PlacedBody& b) { return b.place == place; });
    number[place] = static_cast<int>(surfaces.size());
    surfaces.push_back({body.name,
                        placed.range.first,
                        *placed.rest,
                        placed.surface(),
                        {},
                        body.contact.thickness,
                        body.contact.friction.value_or(scene.contact.friction),
                        body.contact.self,
                        body.contact.others});
  });
  for (size_t i = 0; i < scene.colliders.size(); ++i) {
    const assets::Collider& c = scene.colliders[i];
    if (c.shape != assets::ColliderShape::kMesh) continue;
    number[fmt::format("collider.{}", i + 1)] = static_cast<int>(surfaces.size());
    const sim::TriangleMesh& mesh = shapes.colliders[i]->rest;
    surfaces.push_back(
        {c.name, -1, mesh.vertices, mesh.triangles, make_collider(c).motion, c.thickness, c.friction, false, true});
  }
  std::vector<sim::SurfacePairRule> rules;
  const auto rule_of = [&](const assets::BodyName& a, const assets::BodyName& b) {
    sim::SurfacePairRule rule;
    rule.a = number.at(a.place);
    rule.b = number.at(b.place);
    return rule;
  };
  const auto said = [&](const assets::Attach& attach) {
    return std::any_of(scene.contact.pairs.begin(), scene.contact.pairs.end(), [&](const assets::ContactPair& p) {
      return std::minmax(p.between[0].place, p.between[1].place) ==
             std::minmax(attach.bodies[0].place, attach.bodies[1].place);
    });
  };
  for (const assets::Attach& attach : scene.attachments) {
    if (!number.contains(attach.bodies[0].place) || !number.contains(attach.bodies[1].place)) continue;
    sim::SurfacePairRule rule = rule_of(attach.bodies[0], attach.bodies[1]);
    rule.touch = said(attach);
    rule.tied = true;
    rules.push_back(rule);
  }
  for (const assets::ContactPair& pair : scene.contact.pairs) {
    sim::SurfacePairRule rule = rule_of(pair.between[0], pair.between[1]);
    rule.touch = pair.touch;
    rule.friction = pair.friction.value_or(-1);
    rule.thickness = pair.thickness.value_or(-1);
    rules.push_back(rule);
  }
  builder.set_surfaces(std::move(surfaces), std::move(rules));
}

std::vector<Crossing> crossings(const sim::ContactSurfaces& surfaces, const Eigen::VectorXd& x, double t) {
  std::vector<int> surface_of_triangle;
  for (size_t s = 0; s < surfaces.surfaces.size(); ++s)
    surface_of_triangle.insert(surface_of_triangle.end(), static_cast<size_t>(surfaces.surfaces[s].triangle_count),
                               static_cast<int>(s));
  std::map<std::pair<int, int>, long> count;
  const auto of = [&](int t1, int t2) {
    return std::minmax(surface_of_triangle[static_cast<size_t>(t1)], surface_of_triangle[static_cast<size_t>(t2)]);
  };
  std::vector<char> can_touch(surfaces.surfaces.size() * surfaces.surfaces.size(), 0);
  const auto place = [&](std::pair<int, int> p) {
    return static_cast<size_t>(p.first) * surfaces.surfaces.size() + static_cast<size_t>(p.second);
  };
  for (const sim::SurfacePair& pair : surfaces.pairs) can_touch[place({pair.a, pair.b})] = 1;
  constexpr size_t kMost = 1000000;
  const sim::TriangleMesh mesh{positions_of(surfaces, x, t), surfaces.triangles};
  for (const auto& [t1, t2] :
       assets::crossing_pairs(mesh, kMost, [&](int a, int b) { return can_touch[place(of(a, b))] != 0; }))
    ++count[of(t1, t2)];
  std::vector<Crossing> result;
  for (const auto& [pair, pairs] : count) result.push_back({pair.first, pair.second, pairs});
  return result;
}

void settle_overlaps(const assets::Scene& scene, sim::Model& model) {
  const sim::ContactSurfaces& surfaces = model.surfaces->surfaces();
  std::vector<std::uint8_t> solid(surfaces.surfaces.size(), 0);
  std::fill_n(solid.begin(), scene.soft.size(), 1);  // they come first
  const auto overlaps = [&] {
    std::vector<Crossing> all = crossings(surfaces, model.x0, 0);
    const auto crosses = [&](int a, int b) {
      return std::any_of(all.begin(), all.end(),
                         [&](const Crossing& c) { return std::minmax(c.first, c.second) == std::minmax(a, b); });
    };
    for (const auto& [outer, inner] : enclosed(surfaces, positions_of(surfaces, model.x0, 0), solid))
      if (!crosses(outer, inner)) all.push_back({outer, inner, 0});
    return all;
  };
  std::vector<Crossing> found = overlaps();
  if (found.empty()) return;
  const std::string list = list_of(surfaces, found);
  if (!scene.contact.resolve_overlap)
    refuse(scene, fmt::format("bodies overlap in the first frame: {}. Move them apart (translate), set "
                              "contact.resolve_overlap = true to have whole bodies moved, or let the two pass through "
                              "each other ([[contact.pair]] between = [...], touch = false)",
                              list));
  Separation separation(surfaces, model);
  constexpr int kMostMoves = 100;
  for (int moves = 0; !found.empty(); ++moves) {
    const Crossing& c = found.front();
    // The second of the two, if it can move: scenes are written from the ground up.
    int own = c.second, other = c.first;
    if (!separation.movable(own)) std::swap(own, other);
    const sim::BodyRange* body = c.first == c.second ? nullptr : separation.movable(own);
    if (!body || moves == kMostMoves)
      refuse(scene, fmt::format("bodies overlap in the first frame, and contact.resolve_overlap cannot move them apart "
                                "as whole bodies: {}",
                                list_of(surfaces, found)));
    const double gap = surfaces.surfaces[static_cast<size_t>(own)].half_thickness +
                       surfaces.surfaces[static_cast<size_t>(other)].half_thickness + scene.contact.distance;
    separation.move(*body, separation.way_out(own, other, gap));
    found = overlaps();
  }
}

}  // namespace softreel::app
