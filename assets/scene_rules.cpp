#include "assets/scene_rules.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

#include "assets/scene_contact.h"
#include "assets/scene_limits.h"
#include "assets/scene_nearest.h"
#include "sim/catalogue.h"

namespace softreel::assets {

namespace {

void check_mesh_or(KeyVisitor& v, const MeshSource& mesh, bool made, const char* key, const char* example) {
  const bool wants_mesh = v.given("mesh"), wants_made = v.given(key);
  if (wants_mesh && wants_made)
    v.problem(key, fmt::format("both mesh and {} are given; keep one of them", key));
  else if (!wants_mesh && !wants_made)
    v.problem("", fmt::format("has no shape; add mesh = \"FILE\" or {}", example));
  if (mesh.path.empty() && made) only_for(v, false, {"unit", "up", "size"}, "is for a mesh file");
}

// A material without a volume term takes Poisson's ratio for its shear modulus only.
void note_poisson(KeyVisitor& v, const sim::MaterialTraits& traits, const std::string& model, double young,
                  double poisson) {
  if (traits.volume_term || poisson == 0) return;
  v.note(v.given("material.poisson") ? "material.poisson" : "material",
         fmt::format("model = \"{}\" has no volume term: with poisson = {:g} it behaves as poisson = 0, young = {:.4g}",
                     model, poisson, young / (1 + poisson)));
}

// Names of bodies and colliders are one set: overrides, reports and exports call them by name. Loads and attachments
// have their own.
void check_names(KeyVisitor& v, const Scene& scene) {
  std::map<std::string, std::string> first;  // name -> where it was first used
  const auto collect = [&](const auto& things, const char* kind,
                           const char* whose = "every body, field and collider needs") {
    for (size_t i = 0; i < things.size(); ++i) {
      const std::string place = fmt::format("{}.{}", kind, i + 1);
      const bool given = !things[i].name.empty();
      const std::string name = given ? things[i].name : fmt::format("{}-{}", kind, i + 1);
      const auto [it, added] = first.emplace(name, place);
      if (!added)
        v.problem(given ? place + ".name" : place,
                  fmt::format("the name \"{}\" is already that of {}; {} its own", name, it->second, whose));
    }
  };
  collect(scene.soft, "soft");
  collect(scene.cloth, "cloth");
  collect(scene.springs, "springs");
  collect(scene.fields, "field");
  collect(scene.colliders, "collider");
  first.clear();
  collect(scene.loads, "load", "every load needs");
  first.clear();
  collect(scene.attachments, "attach", "every attachment needs");
}

template <class Visit>
void for_each_body(const Scene& scene, const Visit& visit) {
  for (size_t i = 0; i < scene.soft.size(); ++i) visit(fmt::format("soft.{}", i + 1), scene.soft[i]);
  for (size_t i = 0; i < scene.cloth.size(); ++i) visit(fmt::format("cloth.{}", i + 1), scene.cloth[i]);
  for (size_t i = 0; i < scene.springs.size(); ++i) visit(fmt::format("springs.{}", i + 1), scene.springs[i]);
}

// An equilibrium knows no velocity: what depends on one would be ignored.
void check_static(KeyVisitor& v, const Scene& scene) {
  if (scene.time.integrator != "static") return;
  const auto refuse = [&](const std::string& key) {
    if (v.given(key)) v.problem(key, "has no effect with time.integrator = \"static\", which knows no velocity");
  };
  const auto refuse_load = [&](const std::string& key) {
    if (v.given(key))
      v.problem(key, "has no place in time.integrator = \"static\", where all loads grow together over the clip");
  };
  refuse("damping");
  refuse("wind");
  for (size_t i = 0; i < scene.springs.size(); ++i) refuse(fmt::format("springs.{}.damping", i + 1));
  for (size_t i = 0; i < scene.attachments.size(); ++i) refuse(fmt::format("attach.{}.damping", i + 1));
  for_each_body(scene, [&](const std::string& place, const Body&) {
    refuse(place + ".velocity");
    refuse(place + ".spin");
    refuse(place + ".spring_damping");
  });
  if (!scene.colliders.empty() && !v.given("contact.stiffness"))
    v.problem(
        "time.integrator",
        "static with colliders needs contact.stiffness: the default is made of masses and time steps, which do not "
        "count in an equilibrium");
  for (size_t i = 0; i < scene.loads.size(); ++i)
    for (const char* key : {"from", "until", "ramp"}) refuse_load(fmt::format("load.{}.{}", i + 1, key));
  if (scene.time.frames() < 2)
    v.problem("time.duration",
              "is one frame, of the bodies before any load; time.integrator = \"static\" needs at least two, in which "
              "the loads grow");
  if (scene.solver.method == "fixed-point")
    v.problem("solver.method", "fixed-point divides by the mass, which does not count in an equilibrium; take newton");
}

void check_consistent_mass(KeyVisitor& v, const Scene& scene) {
  if (scene.time.integrator.empty() || sim::is_implicit(scene.time.integrator)) return;
  for_each_body(scene, [&](const std::string& place, const Body& body) {
    if (body.mass != MassModel::kConsistent) return;
    for (size_t p = 0; p < body.pins.size(); ++p)
      if (!body.pins[p].motion.empty())
        v.problem(fmt::format("{}.pins.{}.motion", place, p + 1),
                  fmt::format("drives a body of consistent mass, whose neighbours would feel how the pin accelerates; "
                              "{} leaves that out. Take mass = \"lumped\" or an implicit time.integrator",
                              scene.time.integrator));
  });
}

// No mistakes: a scene is often run with one method and then with another.
void note_contact(KeyVisitor& v, const Scene& scene) {
  const std::string& method = scene.time.integrator;
  if (!has_touching_surfaces(scene) || method == "implicit-euler" || method == "bdf2" || method == "newmark") return;
  v.note(
      v.given("time.integrator") ? "time.integrator" : "time",
      fmt::format("surfaces touch, and {} can step through them: such a step is taken in halves, then the run stops. "
                  "implicit-euler, bdf2 and newmark cannot",
                  method));
}

void note_no_effect(KeyVisitor& v, const Scene& scene) {
  const bool bodies = !scene.soft.empty() || !scene.cloth.empty() || !scene.springs.empty();
  if (v.given("solver") && bodies && !sim::is_implicit(scene.time.integrator))
    v.note("solver", fmt::format("has no effect: {} is explicit and solves nothing", scene.time.integrator));
  if (v.given("contact") && scene.colliders.empty()) v.note("contact", "has no effect: there is no collider");
}

// All share the integrator of [time], and not every equation takes every one.
void check_field_integrators(KeyVisitor& v, const Scene& scene) {
  for (size_t i = 0; i < scene.fields.size(); ++i) {
    const Field& field = scene.fields[i];
    const sim::Catalogue all = sim::field_integrators(field.equation);
    std::vector<std::string> names;
    for (const sim::MethodInfo& info : all) names.emplace_back(info.name);
    if (all.empty() || std::find(names.begin(), names.end(), scene.time.integrator) != names.end()) continue;
    v.problem("time.integrator",
              fmt::format("found \"{}\", which cannot step field {} with equation = \"{}\"; it takes {}",
                          scene.time.integrator, i + 1, field.equation, join_names(names, true)));
  }
}

}  // namespace

void only_for(KeyVisitor& v, bool applies, std::initializer_list<const char*> keys, const char* rule) {
  if (applies) return;
  for (const char* key : keys)
    if (v.given(key)) v.problem(key, rule);
}

void nonzero(KeyVisitor& v, const char* key, const Vec3& direction) {
  if (!(direction.norm() > 1e-9)) v.problem(key, "found [0, 0, 0], expected a direction; its length does not matter");
}

void check(KeyVisitor& v, const Solver& s) {
  const bool newton = s.method == "newton";
  only_for(v, newton,
           {"hessian", "linear", "linear_tolerance", "preconditioner", "omega", "restart", "linear_max_iterations"},
           "is for method = \"newton\"");
  only_for(v, s.method != "fixed-point", {"line_search"}, "is for method = \"newton\" or \"gradient-descent\"");
  if (!newton && s.stop == "decrement")
    v.problem("stop", "decrement is Newton's; with this method expected \"residual\"");
  if (s.method == "gradient-descent" && s.stop == "step")
    v.problem("stop", "the steps of gradient-descent say little about how far the minimum is; expected \"residual\"");
  const bool direct = s.linear == "cholesky" || s.linear == "ldlt" || s.linear == "lu";
  only_for(v, s.linear == "cg" || s.linear == "gmres" || s.linear == "steepest-descent", {"preconditioner"},
           "is for linear = \"cg\", \"gmres\" or \"steepest-descent\"");
  only_for(v, s.linear == "sor", {"omega"}, "is for linear = \"sor\"");
  only_for(v, s.linear == "gmres", {"restart"}, "is for linear = \"gmres\"");
  only_for(v, !direct && s.linear != "auto", {"linear_max_iterations"},
           "is for a linear solver that iterates; auto counts for itself what pays");
}

// What accuracy asks for has to mean something.
void check_accuracy(KeyVisitor& v, const Scene& scene) {
  if (!scene.time.accuracy) return;
  if (scene.time.integrator == "static")
    v.problem("time.accuracy", "is an error in time, and time.integrator = \"static\" knows none; leave it out");
  if (!scene.fields.empty() && scene.time.accuracy->unit != "%")
    v.problem(
        "time.accuracy",
        fmt::format("is {} {}, and the values of a field are no lengths; with [[field]] take \"%\", of their range",
                    scene.time.accuracy->value, scene.time.accuracy->unit));
}

void check(KeyVisitor& v, Scene& scene) {
  check_names(v, scene);
  check_pictures(v, scene);
  check_references(v, scene);
  fill_self_contact(v, scene);
  check_static(v, scene);
  check_accuracy(v, scene);
  check_consistent_mass(v, scene);
  check_field_integrators(v, scene);
  note_contact(v, scene);
  note_no_effect(v, scene);
}

void check(KeyVisitor& v, const Time& time) {
  const double frames = time.duration * time.fps;
  if (frames > kMostFrames)
    v.problem("duration", fmt::format("{} s at {} frames per second are {:.0f} frames, at most {:.0f}", time.duration,
                                      time.fps, frames, kMostFrames));
  else if (frames * time.substeps > kMostSteps)
    v.problem("substeps", fmt::format("{:.0f} frames of {} substeps are {:.0f} steps, at most {:.0f}", frames,
                                      time.substeps, frames * time.substeps, kMostSteps));
}

void check(KeyVisitor& v, const Block& block) {
  const auto& n = block.cells;
  const double tets = double(kTetsPerCell) * n[0] * n[1] * n[2];
  if (tets > kMostTets)
    v.problem("cells", fmt::format("{} x {} x {} cells would be up to {:.0f} tetrahedra, at most {:.0f}", n[0], n[1],
                                   n[2], tets, kMostTets));
}

void check(KeyVisitor& v, const Grid& grid) {
  const double triangles = 2.0 * grid.cells[0] * grid.cells[1];
  if (triangles > kMostTriangles)
    v.problem("cells", fmt::format("{} x {} cells would be {:.0f} triangles, at most {:.0f}", grid.cells[0],
                                   grid.cells[1], triangles, kMostTriangles));
}

void check(KeyVisitor& v, const std::vector<MotionKey>& motion) {
  for (size_t i = 1; i < motion.size(); ++i)
    if (motion[i].t <= motion[i - 1].t)
      v.problem(fmt::format("motion.{}.t", i + 1), fmt::format("found t = {}, expected more than the {} of the key "
                                                               "frame before",
                                                               motion[i].t, motion[i - 1].t));
}

void check(KeyVisitor& v, const Pin& pin) {
  if (!v.given("box") && !v.given("vertices"))
    v.problem("", "says of no vertices that they are held; add box = [[x, y, z], [x, y, z]] or vertices = [...]");
  if (v.given("vertices") && !v.given("box") && pin.vertices.empty()) v.problem("vertices", "no vertices are listed");
  only_for(v, v.given("motion"), {"pivot"}, "is what motion turns about, and there is no motion");
}

void check(KeyVisitor& v, const SoftBody& body) {
  check_mesh_or(v, body.mesh, body.block.has_value(), "block", "block = { size = [1, 1, 1], cells = [8, 8, 8] }");
  only_for(v, !body.block, {"tetrahedralize"}, "is for a mesh; a block is made of tetrahedra already");
  const SolidMaterial& m = body.material;
  note_poisson(v, sim::solid_traits(m.model), m.model, m.young, m.poisson);
}

void check(KeyVisitor& v, const Cloth& cloth) {
  check_mesh_or(v, cloth.mesh, cloth.grid.has_value(), "grid", "grid = { size = [1, 1], cells = [32, 32] }");
  const bool springs = cloth.model == ClothModel::kMassSpring;
  only_for(v, springs, {"springs", "spring_damping"}, "is for model = \"mass-spring\"");
  only_for(v, !springs, {"bending_model", "material.model"}, "is for model = \"membrane\"");
  only_for(v, cloth.springs.structural.has_value(), {"springs.shear"},
           "goes with springs.structural, which is missing");
  const ClothMaterial& m = cloth.material;
  if (!springs) note_poisson(v, sim::membrane_traits(m.model), m.model, m.young, m.poisson);
  only_for(v, !springs, {"material.bending"}, "is for model = \"membrane\"; masses and springs have springs.bend");
}

void check(KeyVisitor& v, const FixedValue& fixed) {
  if (!fixed.boundary && !v.given("box"))
    v.problem("", "says of no vertices that they are held; add boundary = true or box = [[x, y, z], [x, y, z]]");
}

void check(KeyVisitor& v, const Field& field) {
  check_mesh_or(v, field.mesh, field.grid.has_value(), "grid", "grid = { size = [1, 1], cells = [64, 64] }");
  const bool heat = field.equation == "heat", wave = field.equation == "wave";
  only_for(v, heat, {"diffusivity"}, "is for equation = \"heat\"");
  only_for(v, wave, {"speed", "initial_rate"}, "is for equation = \"wave\"");
  only_for(v, heat || wave, {"initial", "mass"},
           "is for equation = \"heat\" or \"wave\"; poisson has no time of its own");
  if (!heat && !wave && field.fixed.empty())
    v.problem("",
              "poisson needs a value somewhere (pure Neumann conditions have no single solution); add fixed = [{ "
              "boundary = true }]");
  only_for(v, field.colorbar, {"label"}, "is written over the colour bar, and colorbar is false");
  if (field.range && !((*field.range)[0] < (*field.range)[1]))
    v.problem("range", "found two values that do not rise, expected [lowest, highest]");
}

void check(KeyVisitor& v, Collider& c) {
  const auto shape = c.shape;
  const bool round = shape == ColliderShape::kSphere || shape == ColliderShape::kCapsule;
  only_for(v, shape == ColliderShape::kPlane, {"normal"}, "is for shape = \"plane\"");
  only_for(v, round, {"radius"}, "is for shape = \"sphere\" or \"capsule\"");
  only_for(v, shape == ColliderShape::kBox, {"size"}, "is for shape = \"box\"");
  only_for(v, shape == ColliderShape::kCapsule, {"height"}, "is for shape = \"capsule\"");
  const bool mesh = shape == ColliderShape::kMesh;
  only_for(v, mesh, {"mesh", "unit", "up", "thickness"}, "is for shape = \"mesh\"");
  if (mesh && c.mesh.path.empty()) v.problem("", "has shape = \"mesh\" and no mesh; add mesh = \"FILE\"");
  nonzero(v, "normal", c.normal);
  c.normal.normalize();
  const Vec3& s = c.transform.scale;
  if (round && (s.x() != s.y() || s.x() != s.z()))
    v.problem("scale", "found three different numbers, expected one: a round shape has to stay round");
}

}  // namespace softreel::assets
