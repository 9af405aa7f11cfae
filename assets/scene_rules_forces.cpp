// Rules for bodies of springs, loads and attachments.
#include <fmt/format.h>

#include <map>

#include "assets/scene_limits.h"
#include "assets/scene_nearest.h"
#include "assets/scene_rules.h"

namespace softreel::assets {

namespace {

void check_count(KeyVisitor& v, const char* key, size_t found, size_t wanted, const char* of_what) {
  if (found > 1 && found != wanted)
    v.problem(key, fmt::format("found {} numbers, expected one, or {}: one for each {}", found, wanted, of_what));
}

void check_edges(KeyVisitor& v, const SpringBody& body) {
  const size_t n = body.points.size();
  std::map<std::pair<int, int>, size_t> first;
  for (size_t e = 0; e < body.edges.size(); ++e) {
    const auto [i, j] = body.edges[e];
    const std::string place = fmt::format("edges.{}", e + 1);
    if (static_cast<size_t>(std::max(i, j)) >= n) {
      v.problem(place, fmt::format("names point {}; there are points 0 to {}", std::max(i, j), n - 1));
      continue;
    }
    if (i == j) {
      v.problem(place, fmt::format("joins point {} with itself", i));
      continue;
    }
    const auto [it, added] = first.emplace(std::minmax(i, j), e);
    if (!added)
      v.problem(place,
                fmt::format("joins the same points as edge {}; add their stiffnesses up in one", it->second + 1));
    const auto& rest = body.rest_length;
    const bool no_length = !rest.empty() && (rest.size() == 1 ? rest[0] : e < rest.size() ? rest[e] : 0) == 0;
    if (body.points[static_cast<size_t>(i)] == body.points[static_cast<size_t>(j)] && !no_length)
      v.problem(place, fmt::format("points {} and {} are at the same place, so the edge has no direction; move one of "
                                   "them, or give it rest_length = 0",
                                   i, j));
  }
}

}  // namespace

void check(KeyVisitor& v, const Chain& chain) {
  if (chain.from == chain.to) v.problem("to", "is where the chain begins; its links would have no length");
}

void check(KeyVisitor& v, const SpringBody& body) {
  const bool points = v.given("points"), chain = v.given("chain");
  if (points && chain)
    v.problem("chain", "both points and chain are given; keep one of them");
  else if (!points && !chain)
    v.problem("", "has no points; add points = [[x, y, z], ...] and edges = [[0, 1], ...], or chain = {}");
  if (points && body.points.empty()) v.problem("points", "no points are listed");
  if (chain && v.given("edges")) v.problem("edges", "is for points; a chain has its own");
  if (static_cast<double>(body.points.size()) > kMostPoints)
    v.problem("points", fmt::format("{} points, at most {:.0f}", body.points.size(), kMostPoints));
  const size_t n = chain && body.chain ? static_cast<size_t>(body.chain->links) + 1 : body.points.size();
  const size_t m = chain && body.chain ? n - 1 : body.edges.size();
  check_count(v, "mass", body.masses.size(), n, "point");
  check_count(v, "radius", body.radius.size(), n, "point");
  check_count(v, "stiffness", body.stiffness.size(), m, "edge");
  check_count(v, "rest_length", body.rest_length.size(), m, "edge");
  if (points && !body.points.empty()) check_edges(v, body);
  for (const char* key : {"look.texture", "look.crease", "look.back_color"})
    if (v.given(key)) v.problem(key, "is for surfaces");
}

void check(KeyVisitor& v, const Load& load) {
  if (!v.given("body")) v.problem("", "acts on nothing; add body = \"NAME\"");
  if (!v.given("box")) v.problem("", "acts nowhere; add box = [[x, y, z], [x, y, z]]");
  const bool force = v.given("force"), traction = v.given("traction");
  if (force && traction)
    v.problem("traction", "both force and traction are given; keep one of them");
  else if (!force && !traction)
    v.problem("", "has no size; add force = [x, y, z] or traction = [x, y, z]");
  if (load.until && *load.until <= load.from)
    v.problem("until", fmt::format("found {}, expected more than from = {}", *load.until, load.from));
}

void check(KeyVisitor& v, const Attach& attach) {
  if (!v.given("bodies")) v.problem("", "ties nothing; add bodies = [\"NAME\", \"OTHER NAME\"]");
  if (!v.given("box") && !v.given("near"))
    v.problem("", "says of no vertices that they are tied; add box = [[x, y, z], [x, y, z]] or near = DISTANCE");
  if (v.given("bodies") && attach.bodies[0].name == attach.bodies[1].name && !attach.bodies[0].name.empty())
    v.problem("bodies", "a body cannot be tied to itself");
}

void fill_self_contact(KeyVisitor& v, Scene& scene) {
  const auto fill = [&](auto& bodies, const char* kind) {
    for (size_t i = 0; i < bodies.size(); ++i)
      if (!v.given(fmt::format("{}.{}.contact.self", kind, i + 1))) bodies[i].contact.self = scene.contact.self;
  };
  fill(scene.soft, "soft");
  fill(scene.cloth, "cloth");
}

void check(KeyVisitor& v, const ContactPair& pair) {
  if (!v.given("between")) v.problem("", "says nothing of whom; add between = [\"NAME\", \"OTHER NAME\"]");
  for (const char* key : {"friction", "thickness"})
    if (!pair.touch && v.given(key)) v.problem(key, "has no effect with touch = false");
}

void check(KeyVisitor& v, const Reference& reference) {
  if (reference.body.name.empty()) v.problem("", "names no body whose motion is known; add body = \"NAME\"");
}

void check_references(KeyVisitor& v, Scene& scene) {
  std::map<std::string, std::string> places;
  std::vector<std::string> names;
  const auto collect = [&](const auto& bodies, const char* kind) {
    for (size_t i = 0; i < bodies.size(); ++i) {
      names.push_back(bodies[i].name.empty() ? fmt::format("{}-{}", kind, i + 1) : bodies[i].name);
      places.emplace(names.back(), fmt::format("{}.{}", kind, i + 1));
    }
  };
  collect(scene.soft, "soft");
  collect(scene.cloth, "cloth");
  collect(scene.springs, "springs");
  const auto find = [&](BodyName& body, const std::string& place, const char* what = "body") {
    if (body.name.empty()) return;  // reported already
    const auto it = places.find(body.name);
    if (it != places.end()) {
      body.place = it->second;
      return;
    }
    const std::string nearest = nearest_name(body.name, names);
    const std::string rest = !nearest.empty() ? fmt::format("did you mean \"{}\"?", nearest)
                             : names.empty()  ? "there is none at all"
                                              : "there is: " + join_names(names);
    v.problem(place, fmt::format("there is no {} \"{}\"; {}", what, body.name, rest));
  };
  for (size_t i = 0; i < scene.loads.size(); ++i) {
    Load& load = scene.loads[i];
    const std::string place = fmt::format("load.{}", i + 1);
    find(load.body, place + ".body");
    if (load.traction && load.body.place.starts_with("springs"))
      v.problem(place + ".traction", "is for surfaces, and a body of springs has none; give it a force");
  }
  for (size_t i = 0; i < scene.attachments.size(); ++i)
    for (size_t k = 0; k < 2; ++k)
      find(scene.attachments[i].bodies[k], fmt::format("attach.{}.bodies.{}", i + 1, k + 1));
  if (scene.reference) find(scene.reference->body, "reference.body");
  collect(scene.colliders, "collider");
  for (size_t i = 0; i < scene.contact.pairs.size(); ++i)
    for (size_t k = 0; k < 2; ++k) {
      BodyName& name = scene.contact.pairs[i].between[k];
      const std::string place = fmt::format("contact.pair.{}.between.{}", i + 1, k + 1);
      find(name, place, "body or collider");
      const auto number = [&] { return std::stoul(name.place.substr(name.place.find('.') + 1)) - 1; };
      if (name.place.starts_with("springs"))
        v.problem(place, "is a body of springs, which has no surface; they touch colliders of simple shapes only");
      if (name.place.starts_with("collider") && scene.colliders[number()].shape != ColliderShape::kMesh)
        v.problem(place,
                  "is a collider of a simple shape, whose friction is its own; pairs are for bodies and mesh "
                  "colliders");
    }
}

}  // namespace softreel::assets
