#include "app/world.h"

#include <fmt/format.h>
#include <algorithm>

#include <numbers>

#include "app/body_part.h"
#include "app/couplings.h"
#include "app/placement.h"
#include "app/touching_surfaces.h"
#include "assets/error.h"
#include "assets/scene_contact.h"
#include "assets/scene_names.h"
#include "sim/free_bodies.h"
#include "sim/model_builder.h"
#include "sim/motion.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;
using sim::Vec3;

std::vector<sim::MotionKey> motion_keys(const std::vector<assets::MotionKey>& keys) {
  std::vector<sim::MotionKey> result;
  for (const assets::MotionKey& k : keys) result.push_back({k.t, k.translate, k.rotate});
  return result;
}

sim::Pin make_pin(const assets::Scene& scene, const assets::Body& body, size_t number, const assets::Pin& pin,
                  const std::vector<Vec3>& rest, const sim::BodyRange& range) {
  const auto refuse = [&](const std::string& why) {
    throw UserError(ErrorKind::kUsage, scene.file.string(),
                    fmt::format("pin {} of '{}' {}", number + 1, body.name, why));
  };
  sim::Pin result;
  std::vector<bool> held(rest.size(), false);
  for (int v : pin.vertices) {
    if (v < 0 || static_cast<size_t>(v) >= rest.size())
      refuse(fmt::format("names vertex {}; the mesh has vertices 0 to {}", v, rest.size() - 1));
    held[static_cast<size_t>(v)] = true;
  }
  if (pin.box)
    for (int v : vertices_in(*pin.box, rest)) held[static_cast<size_t>(v)] = true;
  Vec3 mean = Vec3::Zero();
  for (size_t i = 0; i < rest.size(); ++i)
    if (held[i]) {
      result.vertices.push_back(range.first + static_cast<int>(i));
      mean += rest[i];
    }
  if (result.vertices.empty()) refuse(fmt::format("holds no vertex: the body {}", reach_text(rest)));
  mean /= static_cast<double>(result.vertices.size());
  for (size_t a = 0; a < 3; ++a) result.axes[a] = pin.axes[a];
  if (!pin.motion.empty()) {
    result.motion = sim::Motion(motion_keys(pin.motion), pin.pivot.value_or(mean));
    if (!result.motion.pose(0).isApprox(Eigen::Isometry3d::Identity()))
      refuse(
          "begins its motion away from where the body holds these vertices; begin with { t = 0 }, or with a first "
          "key that moves nothing");
  }
  return result;
}

void finish_body(const assets::Scene& scene, const assets::Body& body, const std::vector<Vec3>& rest,
                 const sim::BodyRange& range, sim::ModelBuilder& builder) {
  builder.set_velocity(range, body.velocity, body.spin * (std::numbers::pi / 180));
  for (size_t p = 0; p < body.pins.size(); ++p) builder.add_pin(make_pin(scene, body, p, body.pins[p], rest, range));
}

std::vector<sim::Spring> springs_of(const assets::Cloth& cloth, const sim::TriangleMesh& rest) {
  const assets::ClothMaterial& m = cloth.material;
  if (!cloth.springs.structural)
    return sim::young_springs(rest, m.young, m.thickness, cloth.springs.bend.value_or(0.1 * m.young * m.thickness));
  const double structural = *cloth.springs.structural;
  const sim::SpringStiffness k{structural, cloth.springs.shear.value_or(0.5 * structural),
                               cloth.springs.bend.value_or(0.1 * structural)};
  return cloth.grid ? sim::grid_springs(rest, cloth.grid->cells[0], cloth.grid->cells[1], k)
                    : sim::mesh_springs(rest, k);
}

sim::BendingModel bending_model(assets::BendingModel model) {
  switch (model) {
    case assets::BendingModel::kAuto:
      return sim::BendingModel::kAuto;
    case assets::BendingModel::kQuadratic:
      return sim::BendingModel::kQuadratic;
    case assets::BendingModel::kDiscreteShell:
      return sim::BendingModel::kDiscreteShell;
  }
  return sim::BendingModel::kAuto;
}

/// What the physics refuses about a body is the user's mistake.
template <class Add>
sim::BodyRange checked(const assets::Scene& scene, const char* kind, const assets::Body& body, const Add& add) {
  try {
    return add();
  } catch (const std::invalid_argument& e) {
    throw UserError(ErrorKind::kInput, scene.file.string(), fmt::format("{} '{}': {}", kind, body.name, e.what()));
  }
}

sim::BodyRange add_soft(const assets::Scene& scene, const assets::SoftBody& soft, const SolidShape& shape,
                        sim::ModelBuilder& builder) {
  const sim::BodyRange range = checked(scene, "soft", soft, [&] {
    return builder.add_solid(soft.name, shape.rest,
                             {soft.material.model, soft.material.young, soft.material.poisson, soft.density,
                              soft.mass == assets::MassModel::kConsistent});
  });
  finish_body(scene, soft, shape.rest.vertices, range, builder);
  return range;
}

sim::BodyRange add_springs(const assets::Scene& scene, const assets::SpringBody& body, const SpringShape& shape,
                           sim::ModelBuilder& builder) {
  const auto of_each = [](const std::vector<double>& list, size_t i) { return list.size() == 1 ? list[0] : list[i]; };
  std::vector<double> masses;
  for (size_t i = 0; i < shape.rest.size(); ++i) masses.push_back(of_each(body.masses, i));
  std::vector<sim::Spring> springs;
  for (size_t e = 0; e < shape.edges.size(); ++e) {
    const auto [i, j] = shape.edges[e];
    const double apart = (shape.rest[static_cast<size_t>(i)] - shape.rest[static_cast<size_t>(j)]).norm();
    springs.push_back(
        {i, j, of_each(body.stiffness, e), body.rest_length.empty() ? apart : of_each(body.rest_length, e)});
  }
  const sim::BodyRange range = builder.add_points(body.name, shape.rest, masses, std::move(springs), body.damping);
  finish_body(scene, body, shape.rest, range, builder);
  return range;
}

sim::BodyRange add_cloth(const assets::Scene& scene, const assets::Cloth& cloth, const ClothShape& shape,
                         sim::ModelBuilder& builder) {
  sim::BodyRange range;
  try {
    if (cloth.model == assets::ClothModel::kMassSpring) {
      range = builder.add_mass_spring(cloth.name, shape.rest, springs_of(cloth, shape.rest), cloth.areal_density(),
                                      cloth.spring_damping);
    } else {
      sim::MembraneMaterial m;
      m.model = cloth.material.model;
      m.young = cloth.material.young;
      m.poisson = cloth.material.poisson;
      m.thickness = cloth.material.thickness;
      m.bending = cloth.material.bending;
      m.bending_model = bending_model(cloth.bending_model);
      m.areal_density = cloth.areal_density();
      m.consistent_mass = cloth.mass == assets::MassModel::kConsistent;
      range = builder.add_membrane(cloth.name, shape.rest, m);
    }
  } catch (const std::invalid_argument& e) {
    throw UserError(ErrorKind::kInput, scene.file.string(), fmt::format("cloth '{}': {}", cloth.name, e.what()));
  }
  finish_body(scene, cloth, shape.rest.vertices, range, builder);
  return range;
}

/// An equilibrium of what can drift away does not exist, or is any place at all.
void refuse_free_bodies(const assets::Scene& scene, const sim::Model& model) {
  const std::vector<sim::FreeBody> free = sim::free_bodies(model);
  if (free.empty()) return;
  std::string list;
  for (const sim::FreeBody& body : free)
    list += fmt::format("{}'{}' along {}", list.empty() ? "" : ", ", body.name, body.axes);
  throw UserError(
      ErrorKind::kUsage, scene.file.string(),
      fmt::format("time.integrator = \"static\" needs bodies that are held, and these are free to move: {}. "
                  "Pin some of their vertices (pins = [{{ box = ... }}]), or take another integrator",
                  list));
}

}  // namespace

bool shows_pressure(const assets::Scene& scene) {
  const auto shows = [](const assets::Body& b) { return b.data && b.data->show == assets::Quantity::kPressure; };
  return std::any_of(scene.soft.begin(), scene.soft.end(), shows) ||
         std::any_of(scene.cloth.begin(), scene.cloth.end(), shows);
}

sim::Collider make_collider(const assets::Collider& c) {
  sim::Collider result;
  const double scale = c.transform.scale.x();
  Eigen::Matrix3d R = sim::euler_xyz(c.transform.rotate);
  switch (c.shape) {
    case assets::ColliderShape::kPlane:
      result.shape = sim::PlaneShape{};
      R = R * Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(), c.normal).toRotationMatrix();
      break;
    case assets::ColliderShape::kSphere:
      result.shape = sim::SphereShape{c.radius * scale};
      break;
    case assets::ColliderShape::kBox:
      result.shape = sim::BoxShape{0.5 * c.transform.scale.cwiseProduct(c.size)};
      break;
    case assets::ColliderShape::kMesh:
      result.shape = sim::SurfaceShape{};
      break;
    case assets::ColliderShape::kCapsule:
      result.shape = sim::CapsuleShape{c.radius * scale, 0.5 * c.height * scale};
      break;
  }
  result.world_from_shape.linear() = R;
  result.world_from_shape.translation() = placed(c.transform, Vec3::Zero());
  if (!c.motion.empty()) result.motion = sim::Motion(motion_keys(c.motion), result.world_from_shape.translation());
  result.friction = c.friction;
  return result;
}

sim::Model build_model(const assets::Scene& scene, const Shapes& shapes) {
  sim::ModelBuilder builder;
  std::vector<PlacedBody> bodies;
  const auto number = [](const char* kind, size_t i) { return fmt::format("{}.{}", kind, i + 1); };
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    const sim::TetMesh& rest = shapes.soft[i].rest;
    bodies.push_back({number("soft", i), scene.soft[i].name, add_soft(scene, scene.soft[i], shapes.soft[i], builder),
                      &rest.vertices, &rest, nullptr});
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i) {
    const sim::TriangleMesh& rest = shapes.cloth[i].rest;
    bodies.push_back({number("cloth", i), scene.cloth[i].name,
                      add_cloth(scene, scene.cloth[i], shapes.cloth[i], builder), &rest.vertices, nullptr, &rest});
  }
  for (size_t i = 0; i < scene.springs.size(); ++i)
    bodies.push_back({number("springs", i), scene.springs[i].name,
                      add_springs(scene, scene.springs[i], shapes.springs[i], builder), &shapes.springs[i].rest,
                      nullptr, nullptr});
  add_couplings(scene, bodies, builder);
  std::vector<sim::Collider> colliders;
  for (const assets::Collider& c : scene.colliders)
    if (c.shape != assets::ColliderShape::kMesh) colliders.push_back(make_collider(c));
  if (assets::has_touching_surfaces(scene)) add_touching_surfaces(scene, shapes, bodies, builder);
  sim::Model model =
      builder.finish(scene.gravity, {scene.damping.drag, scene.damping.alpha, scene.damping.beta}, std::move(colliders),
                     {scene.contact.distance, scene.contact.slip_speed, scene.contact.stiffness.value_or(0),
                      sim::is_implicit(scene.time.integrator) ? 100.0 : sim::kExplicitHardness,
                      sim::is_implicit(scene.time.integrator) ? 1.0 : 0.0});
  if (model.surfaces) settle_overlaps(scene, model);
  if (scene.time.integrator == "static") refuse_free_bodies(scene, model);
  return model;
}

sim::SimulationSettings simulation_settings(const assets::Scene& scene) {
  sim::SimulationSettings s;
  s.integrator = scene.time.integrator;
  s.linear_solver.method = scene.solver.linear;
  s.linear_solver.preconditioner = scene.solver.preconditioner;
  s.linear_solver.omega = scene.solver.omega;
  s.linear_solver.restart = scene.solver.restart;
  s.linear_solver.max_iterations = scene.solver.linear_max_iterations;
  s.minimizer.method = scene.solver.method;
  s.minimizer.hessian = scene.solver.hessian;
  s.minimizer.line_search = scene.solver.line_search;
  s.minimizer.stop = scene.solver.stop;
  s.minimizer.tolerance = scene.solver.tolerance;
  s.minimizer.max_iterations = scene.solver.max_iterations;
  s.minimizer.linear_tolerance = scene.solver.linear_tolerance;
  s.sleep_speed = assets::sleep_speed(scene);
  s.max_halvings = scene.time.max_halvings;
  // The last frame shows the full load.
  if (scene.time.integrator == "static") s.load_time = (scene.time.frames() - 1) / scene.time.fps;
  return s;
}

}  // namespace softreel::app
