#include "app/couplings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "app/body_part.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

using sim::Triangle;
using sim::Vec3;

[[noreturn]] void refuse(const assets::Scene& scene, const std::string& why) {
  throw assets::UserError(assets::ErrorKind::kUsage, scene.file.string(), why);
}

const PlacedBody& find(const std::vector<PlacedBody>& bodies, const assets::BodyName& name) {
  return *std::find_if(bodies.begin(), bodies.end(), [&](const PlacedBody& b) { return b.place == name.place; });
}

void add_load(const assets::Scene& scene, const assets::Load& load, const PlacedBody& body,
              sim::ModelBuilder& builder) {
  const sim::LoadTimes times{load.from, load.until.value_or(std::numeric_limits<double>::infinity()), load.ramp};
  if (load.force) {
    std::vector<int> vertices = vertices_in(*load.box, *body.rest);
    if (vertices.empty())
      refuse(scene, fmt::format("load '{}' finds no vertex of '{}' in its box: the body {}", load.name, body.name,
                                reach_text(*body.rest)));
    for (int& v : vertices) v += body.range.first;
    builder.add_load(sim::share_force(*load.force, vertices, builder.masses()), times);
    return;
  }
  std::vector<Triangle> inside;
  for (Triangle t : body.surface()) {
    if (!std::all_of(t.begin(), t.end(),
                     [&](int v) { return contains(*load.box, (*body.rest)[static_cast<size_t>(v)]); }))
      continue;
    for (int& v : t) v += body.range.first;
    inside.push_back(t);
  }
  if (inside.empty())
    refuse(scene, fmt::format("load '{}' finds no surface triangle of '{}' that lies in its box with all corners: the "
                              "body {}",
                              load.name, body.name, reach_text(*body.rest)));
  builder.add_load(sim::share_traction(*load.traction, inside, builder.positions()), times);
}

std::vector<sim::Tie> ties_of(const assets::Scene& scene, const assets::Attach& attach, const PlacedBody& a,
                              const PlacedBody& b, const Eigen::VectorXd& stiffness) {
  std::vector<int> vertices(a.rest->size());
  std::iota(vertices.begin(), vertices.end(), 0);
  if (attach.box) vertices = vertices_in(*attach.box, *a.rest);
  if (vertices.empty())
    refuse(scene, fmt::format("attachment '{}' finds no vertex of '{}' in its box: the body {}", attach.name, a.name,
                              reach_text(*a.rest)));
  sim::AttachSettings settings;
  settings.near = attach.near.value_or(std::numeric_limits<double>::infinity());
  settings.snap = attach.snap;
  settings.stiffness = attach.stiffness.value_or(0);
  try {
    std::vector<sim::Tie> ties = sim::find_ties({a.range.first, a.rest, {}}, vertices,
                                                {b.range.first, b.rest, b.surface()}, settings, stiffness);
    if (ties.empty())
      refuse(scene,
             fmt::format("attachment '{}' ties nothing: no vertex of '{}' is within {} m of '{}'; '{}' {}, '{}' {}",
                         attach.name, a.name, settings.near, b.name, a.name, reach_text(*a.rest), b.name,
                         reach_text(*b.rest)));
    return ties;
  } catch (const std::invalid_argument& e) {
    refuse(scene, fmt::format("attachment '{}': {}", attach.name, e.what()));
  }
}

void set_wind(const assets::Wind& w, const std::vector<PlacedBody>& bodies, sim::ModelBuilder& builder) {
  sim::Wind wind;
  wind.velocity = w.velocity;
  wind.density = w.density;
  wind.drag = w.drag;
  wind.friction = w.friction;
  if (w.gusts) {
    wind.gusts = w.gusts->amplitude;
    wind.gust_period = w.gusts->period;
    wind.seed = w.gusts->seed;
  }
  std::vector<sim::WindSurface> surfaces;
  for (const PlacedBody& body : bodies) {
    sim::WindSurface surface{body.surface(), body.solid != nullptr};
    for (Triangle& t : surface.triangles)
      for (int& v : t) v += body.range.first;
    if (!surface.triangles.empty()) surfaces.push_back(std::move(surface));
  }
  builder.set_wind(wind, std::move(surfaces));
}

}  // namespace

std::vector<Triangle> PlacedBody::surface() const {
  if (solid) return sim::boundary_triangles(*solid);
  return sheet ? sheet->triangles : std::vector<Triangle>();
}

void add_couplings(const assets::Scene& scene, const std::vector<PlacedBody>& bodies, sim::ModelBuilder& builder) {
  for (const assets::Load& load : scene.loads) add_load(scene, load, find(bodies, load.body), builder);
  if (!scene.attachments.empty()) {
    const Eigen::VectorXd stiffness = builder.stiffness();  // without any tie
    for (const assets::Attach& attach : scene.attachments)
      builder.add_ties(
          ties_of(scene, attach, find(bodies, attach.bodies[0]), find(bodies, attach.bodies[1]), stiffness),
          attach.damping);
  }
  if (scene.wind) set_wind(*scene.wind, bodies, builder);
}

}  // namespace softreel::app
