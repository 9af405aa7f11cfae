#include "app/bill.h"

#include <fmt/format.h>

#include <algorithm>

#include "assets/scene_contact.h"
#include "assets/scene_names.h"
#include "assets/tet_file.h"
#include "sim/simulation.h"

namespace softreel::app {

using namespace assets;

std::vector<BillItem> bill_of(const Scene& s) {
  std::vector<BillItem> bill;
  const auto add = [&](const char* feature, bool needed, const std::string& if_needed, const std::string& if_not) {
    bill.push_back({feature, needed, needed ? if_needed : if_not});
  };
  const auto count = [](const auto& list, const auto& is) { return std::count_if(list.begin(), list.end(), is); };

  const auto number = [](auto n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  const auto surfaces =
      count(s.soft, [](const SoftBody& b) { return !b.mesh.path.empty() && !is_tet_file(b.mesh.path); });
  add("tetrahedralization (TetGen)", surfaces > 0,
      number(surfaces, "soft body is a surface", "soft bodies are surfaces"),
      s.soft.empty() ? "there is no soft body" : "every soft body comes as tetrahedra");
  add("tetrahedral solids", !s.soft.empty(), number(s.soft.size(), "soft body", "soft bodies"),
      "there is no soft body");
  const auto membranes = count(s.cloth, [](const Cloth& c) { return c.model == ClothModel::kMembrane; });
  add("membranes", membranes > 0, number(membranes, "cloth", "cloths"), "no cloth is a membrane");
  const auto bending =
      count(s.cloth, [](const Cloth& c) { return c.model == ClothModel::kMembrane && c.material.bending > 0; });
  add("bending", bending > 0, number(bending, "membrane has a bending stiffness", "membranes have a bending stiffness"),
      membranes > 0 ? "material.bending is 0" : "no cloth is a membrane");
  const auto springs = count(s.cloth, [](const Cloth& c) { return c.model == ClothModel::kMassSpring; });
  add("springs", springs > 0 || !s.springs.empty(),
      springs > 0 ? number(springs, "cloth", "cloths") : number(s.springs.size(), "body of points", "bodies of points"),
      "no cloth is mass-spring, and there are no points");
  add("loads", !s.loads.empty(), number(s.loads.size(), "load", "loads"), "there is no load");
  add("attachments", !s.attachments.empty(), number(s.attachments.size(), "attachment", "attachments"),
      "nothing is tied together");
  add("wind", s.wind.has_value(),
      !s.wind         ? ""
      : s.wind->gusts ? fmt::format("{:.4g} m/s with gusts", s.wind->velocity.norm())
                      : fmt::format("{:.4g} m/s", s.wind->velocity.norm()),
      "there is no [wind]");
  const bool bodies = !s.soft.empty() || !s.cloth.empty() || !s.springs.empty();
  add("gravity", bodies && s.gravity.squaredNorm() > 0, fmt::format("{:.4g} m/s^2", s.gravity.norm()),
      bodies ? "gravity is zero" : "there is no body");
  const bool damped = s.damping.drag + s.damping.alpha + s.damping.beta > 0 ||
                      count(s.cloth, [](const Cloth& c) { return c.spring_damping > 0; }) > 0 ||
                      count(s.springs, [](const SpringBody& b) { return b.damping > 0; }) > 0 ||
                      count(s.attachments, [](const Attach& a) { return a.damping > 0; }) > 0;
  add("damping", damped, "[damping] or the damping of springs or ties is set", "nothing is damped");
  const auto pinned = [](const Body& b) { return !b.pins.empty(); };
  add("pins", count(s.soft, pinned) + count(s.cloth, pinned) + count(s.springs, pinned) > 0, "some vertices are held",
      "no vertex is held");
  const auto simple = count(s.colliders, [](const Collider& c) { return c.shape != ColliderShape::kMesh; });
  add("contact with colliders", simple > 0, number(simple, "collider", "colliders"),
      s.colliders.empty() ? "there is no collider" : "colliders are meshes, which are among the surfaces");
  const auto touchable =
      s.soft.size() + s.cloth.size() +
      static_cast<size_t>(count(s.colliders, [](const Collider& c) { return c.shape == ColliderShape::kMesh; }));
  const bool touching = has_touching_surfaces(s);
  add("contact between surfaces", touching,
      touchable > 1 ? number(touchable, "surface", "surfaces") : "a body touches itself",
      touchable > 0 ? "a single surface, which does not ask for contact with itself"
                    : "there is no surface that could touch another");
  const double sleep = sleep_speed(s);
  add("sleeping bodies", sleep > 0, fmt::format("bodies slower than {:.3g} m/s fall asleep", sleep),
      s.contact.sleep_speed == 0.0 ? "contact.sleep_speed is 0"
      : s.time.accuracy            ? "time.accuracy watches smaller motions"
                                   : "bodies touch nothing on which they could come to rest");
  const bool still = s.time.integrator == "static";
  add("friction", !still && count(s.colliders, [](const Collider& c) { return c.friction > 0; }) > 0,
      "some colliders are rough",
      still                 ? "an equilibrium knows no velocity"
      : s.colliders.empty() ? "there is no collider"
                            : "every collider's friction is 0");
  const std::string& integrator = s.time.integrator;
  const bool implicit = sim::is_implicit(integrator), newton = s.solver.method == "newton";
  add("Hessians and a linear solver", bodies && implicit && newton,
      fmt::format("{} solves a system in each step (linear = {})", integrator, s.solver.linear),
      !bodies     ? "there is no body"
      : !implicit ? fmt::format("{} is explicit", integrator)
                  : fmt::format("{} uses gradients alone", s.solver.method));
  add("scalar fields", !s.fields.empty(), number(s.fields.size(), "field", "fields"), "there is no field");
  const auto figure = [](const auto& body) { return body.visible && body.data; };
  const auto figures = count(s.soft, figure) + count(s.cloth, figure);
  add("figures as colours", figures > 0, number(figures, "body shows its data", "bodies show their data"),
      "no body has data");
  const auto scale = [&](const auto& body) { return figure(body) && body.data->colorbar; };
  add("colour bars",
      count(s.fields, [](const Field& f) { return f.colorbar; }) + count(s.soft, scale) + count(s.cloth, scale) > 0,
      "a scale is shown",
      s.fields.empty() && figures == 0 ? "there is no field, and no body has data" : "colorbar is false");
  add("estimate of the error in time", s.time.accuracy.has_value(),
      "time.accuracy is given: coarser runs, to compare with", "no time.accuracy is given");
  add("shadow maps", count(s.lights, [](const Light& l) { return l.shadow; }) > 0, "a light casts shadows",
      "no light casts shadows");
  add("accumulation buffer", s.render.samples != 1,
      s.render.samples == 0 ? std::string("samples = auto") : fmt::format("samples = {}", s.render.samples),
      "samples = 1");
  add("motion blur", s.render.shutter > 0, fmt::format("shutter = {:.4g}", s.render.shutter), "shutter = 0");
  add("depth of field", s.camera.aperture > 0, fmt::format("aperture = {:.4g} m", s.camera.aperture), "aperture = 0");
  add("estimate of the error of pictures", s.render.samples == 0, "samples = auto", "samples is a number");
  const auto look_has = [&](auto has) {
    return count(s.soft, [&](const SoftBody& b) { return has(b.look); }) +
           count(s.cloth, [&](const Cloth& c) { return has(c.look); }) +
           count(s.springs, [&](const SpringBody& b) { return has(b.look); }) +
           count(s.colliders, [&](const Collider& c) { return has(c.look); });
  };
  add("shadows of the sky", s.render.sky_shadow && s.render.sky > 0, "bodies hide the sky",
      "sky_shadow is false, or sky is 0");
  add("sky picture", !s.render.sky_map.empty(), "sky_map lights the scene", "no sky_map is given");
  add("sheen", look_has([](const Look& l) { return l.sheen > 0; }) > 0, "a look has sheen", "no look has sheen");
  add("emission", look_has([](const Look& l) { return l.emission || !l.emission_texture.empty(); }) > 0,
      "a look gives off light", "no look gives off light (mesh files may bring some)");
  add("patterns",
      look_has([](const Look& l) { return l.pattern != Pattern::kNone; }) > 0 ||
          s.render.ground.pattern != Pattern::kNone,
      "a look or the ground has one", "no look has a pattern");
  add("edges of triangles", look_has([](const Look& l) { return l.wire.has_value(); }) > 0, "a look has wire",
      "no look has wire");
  add("textures", count(s.assets, [](const AssetUse& a) { return !a.physics && a.key != "render.sky_map"; }) > 0,
      "a look names a texture", "no look names a texture (mesh files may bring their own)");
  return bill;
}

}  // namespace softreel::app
