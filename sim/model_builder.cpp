#include "sim/model_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "sim/bending.h"
#include "sim/contact/surface_contact.h"
#include "sim/drag.h"
#include "sim/gravity.h"
#include "sim/mass.h"
#include "sim/membrane.h"
#include "sim/solid.h"
#include "sim/spring_damping.h"
#include "sim/stiffness_damping.h"
#include "sim/stiffness_scale.h"

// tests/needs builds this file a second time without them, to count what they cost scenes that do not use them.
#ifndef SOFTREEL_OPTIONAL_TERMS
#define SOFTREEL_OPTIONAL_TERMS 1
#endif

namespace softreel::sim {
namespace {

/// Is an optional term to be built? A program without optional terms knows that none is, and links none.
inline bool wanted(bool asked) {
  if constexpr (SOFTREEL_OPTIONAL_TERMS) return asked;
  if (asked) throw std::logic_error("this program was built without optional terms");
  return false;
}

}  // namespace

BodyRange ModelBuilder::add_body(const std::string& name, const std::vector<Vec3>& rest,
                                 const std::vector<double>& masses) {
  BodyRange body{name, static_cast<int>(masses_.size()), static_cast<int>(rest.size())};
  masses_.insert(masses_.end(), masses.begin(), masses.end());
  for (const Vec3& p : rest) x_.insert(x_.end(), p.data(), p.data() + 3);
  v_.resize(x_.size(), 0.0);
  model_.bodies.push_back(body);
  return body;
}

template <class Mesh>
void ModelBuilder::add_mass_correction(const Mesh& rest, double density, const BodyRange& body) {
  model_.mass_corrections.push_back(make_mass_correction(rest, density, body.first));
  scaled_corrections_.push_back([rest, density, first = body.first](double factor) {
    return make_mass_correction(rest, factor * density, first);
  });
}

BodyRange ModelBuilder::add_solid(const std::string& name, const TetMesh& rest, const SolidMaterial& m) {
  const BodyRange body = add_body(name, rest.vertices, lumped_masses(rest, m.density));
  model_.potentials.push_back(make_solid(m.model, m.young, m.poisson, rest, body.first));
  if (wanted(m.consistent_mass)) add_mass_correction(rest, m.density, body);
  return body;
}

BodyRange ModelBuilder::add_membrane(const std::string& name, const TriangleMesh& rest, const MembraneMaterial& m) {
  const BodyRange body = add_body(name, rest.vertices, lumped_masses(rest, m.areal_density));
  model_.potentials.push_back(make_membrane(m.model, m.young, m.poisson, m.thickness, rest, body.first));
  if (wanted(m.consistent_mass)) add_mass_correction(rest, m.areal_density, body);
  if (wanted(m.bending > 0)) {
    const bool quadratic =
        m.bending_model == BendingModel::kQuadratic || (m.bending_model == BendingModel::kAuto && is_flat(rest));
    model_.potentials.push_back(quadratic ? make_quadratic_bending(rest, m.bending, body.first)
                                          : make_discrete_shell_bending(rest, m.bending, body.first));
  }
  return body;
}

BodyRange ModelBuilder::add_mass_spring(const std::string& name, const TriangleMesh& rest, std::vector<Spring> springs,
                                        double areal_density, double spring_damping) {
  return add_points(name, rest.vertices, lumped_masses(rest, areal_density), std::move(springs), spring_damping);
}

BodyRange ModelBuilder::add_points(const std::string& name, const std::vector<Vec3>& points,
                                   const std::vector<double>& masses, std::vector<Spring> springs,
                                   double spring_damping) {
  const BodyRange body = add_body(name, points, masses);
  if (!wanted(!springs.empty())) return body;
  for (Spring& s : springs) {
    s.a += body.first;
    s.b += body.first;
  }
  model_.potentials.push_back(make_springs(springs));
  if (wanted(spring_damping > 0)) model_.dissipations.push_back(make_spring_damping(springs, spring_damping));
  return body;
}

void ModelBuilder::set_velocity(const BodyRange& body, const Vec3& velocity, const Vec3& spin) {
  Vec3 centre = Vec3::Zero();
  double mass = 0;
  const auto position = [&](int i) { return Eigen::Map<const Vec3>(x_.data() + 3 * static_cast<size_t>(i)); };
  for (int i = body.first; i < body.first + body.count; ++i) {
    mass += masses_[static_cast<size_t>(i)];
    centre += masses_[static_cast<size_t>(i)] * position(i);
  }
  centre /= mass;
  for (int i = body.first; i < body.first + body.count; ++i)
    Eigen::Map<Vec3>(v_.data() + 3 * static_cast<size_t>(i)) += velocity + spin.cross(position(i) - centre);
}

/// Their bodies are moved by what may change.
void ModelBuilder::keep_awake(std::span<const int> vertices) {
  model_.restless.resize(model_.bodies.size(), 0);
  for (const int v : vertices)
    for (size_t b = 0; b < model_.bodies.size(); ++b)
      if (v >= model_.bodies[b].first && v < model_.bodies[b].first + model_.bodies[b].count) model_.restless[b] = 1;
}

void ModelBuilder::add_pin(Pin pin) {
  if (!pin.motion.still()) keep_awake(pin.vertices);
  model_.pins.push_back(std::move(pin));
}

void ModelBuilder::add_load(NodalForces forces, const LoadTimes& times) {
  if (times.change()) keep_awake(forces.vertices);
  loads_.push_back(make_load(std::move(forces), times));
}

void ModelBuilder::add_ties(const std::vector<Tie>& ties, double damping) {
  if (!wanted(!ties.empty())) return;
  for (auto& term : make_ties(ties)) model_.potentials.push_back(std::move(term));
  if (damping <= 0) return;
  for (auto& term : make_tie_damping(ties, damping)) model_.dissipations.push_back(std::move(term));
}

void ModelBuilder::set_wind(const Wind& wind, std::vector<WindSurface> surfaces) {
  wind_ = wind;
  wind_surfaces_ = std::move(surfaces);
}

Eigen::VectorXd ModelBuilder::masses() const {
  return Eigen::Map<const Eigen::VectorXd>(masses_.data(), static_cast<Eigen::Index>(masses_.size()));
}

Eigen::VectorXd ModelBuilder::positions() const {
  return Eigen::Map<const Eigen::VectorXd>(x_.data(), static_cast<Eigen::Index>(x_.size()));
}

Eigen::VectorXd ModelBuilder::stiffness() const { return stiffness_scale(model_.potentials, positions()); }

Model ModelBuilder::finish(const Vec3& gravity, const Damping& damping, std::vector<Collider> colliders,
                           const ContactSettings& settings) {
  Model& m = model_;
  m.masses = masses();
  m.x0 = positions();
  if (wind_)
    m.restless.assign(m.bodies.size(), 1);
  else if (!m.restless.empty())
    m.restless.resize(m.bodies.size(), 0);
  m.v0 = Eigen::Map<const Eigen::VectorXd>(v_.data(), static_cast<Eigen::Index>(v_.size()));
  if (wanted(damping.beta > 0)) {
    std::vector<const EnergyTerm*> elastic;
    for (const auto& term : m.potentials) elastic.push_back(term.get());
    for (const EnergyTerm* term : elastic) m.dissipations.push_back(make_stiffness_damping(*term, damping.beta));
  }
  if (gravity.squaredNorm() > 0) m.potentials.push_back(make_gravity(m.masses, gravity));
  for (auto& load : loads_) m.potentials.push_back(std::move(load));
  // Drag is against the air, Rayleigh's part against rest.
  const double still = damping.alpha + (wind_ ? 0 : damping.drag);
  if (wanted(still > 0)) m.dissipations.push_back(make_drag(m.masses, still));
  if (wanted(damping.alpha > 0))  // alpha M, of the mass as it is; drag is one force per vertex
    for (const auto& make : scaled_corrections_) m.dissipations.push_back(make(damping.alpha));
  if (wanted(wind_.has_value() && damping.drag > 0))
    m.dissipations.push_back(make_wind_drag(*wind_, m.masses, damping.drag));
  if (wanted(!wind_surfaces_.empty() && wind_->density * (wind_->drag + wind_->friction) > 0))
    m.dissipations.push_back(make_wind(*wind_, wind_surfaces_));
  if (wanted(!colliders.empty())) {
    const bool rough =
        std::any_of(colliders.begin(), colliders.end(), [](const Collider& c) { return c.friction > 0; });
    auto contact = std::make_unique<ColliderContact>(m.masses, std::move(colliders), settings);
    m.contact = contact.get();
    if (rough) m.dissipations.push_back(make_collider_friction(*contact, settings.slip_speed));
    m.potentials.push_back(std::move(contact));
  }
  if (wanted(!surfaces_.empty())) {
    auto surfaces = std::make_unique<const ContactSurfaces>(surfaces_, surface_rules_);
    if (surfaces->any()) {
      const bool rough = std::any_of(surfaces->pairs.begin(), surfaces->pairs.end(),
                                     [](const SurfacePair& pair) { return pair.friction > 0; });
      auto contact = std::make_unique<SurfaceContact>(
          std::move(surfaces), m.masses, stiffness(),
          SurfaceContactSettings{settings.distance, settings.stiffness, std::min(settings.hardness, kSurfaceHardness),
                                 settings.material});
      m.surfaces = contact.get();
      if (rough) m.dissipations.push_back(make_surface_friction(*contact, settings.slip_speed));
      m.potentials.push_back(std::move(contact));
    }
  }
  Model built = std::move(model_);
  *this = ModelBuilder();
  return built;
}

}  // namespace softreel::sim
