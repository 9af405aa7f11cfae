#include "app/field_world.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "assets/error.h"
#include "assets/formula.h"
#include "sim/field_stability.h"
#include "sim/integrators.h"
#include "sim/mesh_topology.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;
using sim::Vec3;

[[noreturn]] void refuse(const assets::Scene& scene, const assets::Field& field, const std::string& why) {
  throw UserError(ErrorKind::kUsage, scene.file.string(), fmt::format("field '{}': {}", field.name, why));
}

sim::FieldFunction function_of(const assets::Scene& scene, const assets::Field& field, const char* key,
                               const std::string& text) {
  const assets::Formula formula(text);
  if (formula.is_zero()) return {};
  return {[&scene, &field, key, formula](const Vec3& x, double t) {
            const double value = formula(x, t);
            if (!std::isfinite(value))
              refuse(scene, field,
                     fmt::format("{} has no finite value at ({:.4g}, {:.4g}, {:.4g}) [m], t = {:.4g} s", key, x.x(),
                                 x.y(), x.z(), t));
            return value;
          },
          formula.uses_time()};
}

sim::FixedValues fixed_values(const assets::Scene& scene, const assets::Field& field, size_t number,
                              const sim::TriangleMesh& mesh) {
  const assets::FixedValue& f = field.fixed[number];
  sim::FixedValues result;
  std::vector<bool> held(mesh.vertices.size(), false);
  if (f.boundary)
    for (int v : sim::boundary_vertices(mesh)) held[static_cast<size_t>(v)] = true;
  Eigen::AlignedBox3d bounds;
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& p = mesh.vertices[i];
    bounds.extend(p);
    if (f.box && (p.array() >= f.box->lo.array()).all() && (p.array() <= f.box->hi.array()).all()) held[i] = true;
  }
  for (size_t i = 0; i < held.size(); ++i)
    if (held[i]) result.vertices.push_back(static_cast<int>(i));
  if (result.vertices.empty())
    refuse(scene, field,
           fmt::format("fixed {} holds no vertex: {}the mesh reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, "
                       "{:.4g}) [m]",
                       number + 1, f.boundary ? "the surface is closed, and " : "", bounds.min().x(), bounds.min().y(),
                       bounds.min().z(), bounds.max().x(), bounds.max().y(), bounds.max().z()));
  result.value = function_of(scene, field, "the value of fixed", f.value);
  return result;
}

constexpr int kMostSubsteps = 100000;

void check_step(const assets::Scene& scene, const assets::Field& description, const sim::Field& field) {
  const assets::Time& time = scene.time;
  if (description.equation == "poisson" || sim::is_implicit(time.integrator)) return;
  const double largest = field.largest_eigenvalue();
  const std::string& equation = description.equation;
  if (sim::step_holds(equation, time.integrator, largest, time.step(), time.duration)) return;
  const int steps =
      sim::steps_that_hold(equation, time.integrator, largest, 1 / time.fps, time.duration, kMostSubsteps);
  const std::string hold =
      steps > 0 ? fmt::format("time.substeps = {} holds (steps of {:.3g} s)", steps, 1 / (time.fps * steps))
                : fmt::format("not even {} substeps would hold", kMostSubsteps);
  refuse(scene, description,
         fmt::format("steps of {:.3g} s (time.substeps = {}) are too long for {}: the fastest {} of this mesh ({:.4g} "
                     "1/s) would grow without bound. {}; coarser cells allow longer steps, and "
                     "time.integrator = \"implicit-euler\" any",
                     time.step(), time.substeps, time.integrator, equation == "heat" ? "decay" : "wave",
                     equation == "heat" ? largest : std::sqrt(largest), hold));
}

}  // namespace

std::vector<sim::Field> build_fields(const assets::Scene& scene, const Shapes& shapes) {
  std::vector<sim::Field> fields;
  for (size_t i = 0; i < scene.fields.size(); ++i) {
    const assets::Field& f = scene.fields[i];
    sim::FieldProblem p;
    p.equation = f.equation;
    p.mesh = shapes.fields[i].rest;
    p.diffusivity = f.diffusivity;
    p.speed = f.speed;
    p.mass = f.mass == assets::MassModel::kLumped ? sim::FieldMass::kLumped : sim::FieldMass::kConsistent;
    p.source = function_of(scene, f, "source", f.source);
    p.initial = function_of(scene, f, "initial", f.initial);
    p.initial_rate = function_of(scene, f, "initial_rate", f.initial_rate);
    for (size_t k = 0; k < f.fixed.size(); ++k) p.fixed.push_back(fixed_values(scene, f, k, p.mesh));
    try {
      fields.emplace_back(std::move(p), scene.time.integrator);
    } catch (const std::invalid_argument& e) {
      refuse(scene, f, e.what());
    }
    if (!scene.time.accuracy) check_step(scene, f, fields.back());  // which chooses steps that hold
  }
  return fields;
}

double field_steps_per_frame(const assets::Scene& scene, const std::vector<sim::Field>& fields) {
  const assets::Time& time = scene.time;
  int most = 1;
  for (size_t i = 0; i < fields.size(); ++i) {
    const assets::Field& f = scene.fields[i];
    if (f.equation == "poisson" || sim::is_implicit(time.integrator)) continue;
    const int steps = sim::steps_that_hold(f.equation, time.integrator, fields[i].largest_eigenvalue(), 1 / time.fps,
                                           time.duration, kMostSubsteps);
    if (steps == 0)
      refuse(scene, f,
             fmt::format("not even {} steps a frame of {} hold; coarser cells allow longer "
                         "steps, and time.integrator = \"implicit-euler\" any",
                         kMostSubsteps, time.integrator));
    most = std::max(most, steps);
  }
  return most;
}

}  // namespace softreel::app
