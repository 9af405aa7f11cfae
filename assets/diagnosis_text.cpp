// The sentence a user reads about a surface that bounds no solid.
#include <fmt/format.h>

#include "assets/surface_diagnosis.h"

namespace softreel::assets {
namespace {

std::string plural(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string place(const Defect& defect) {
  if (defect.where.empty()) return "";
  const sim::Vec3& p = defect.where.front();
  return fmt::format(" near ({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

}  // namespace

std::string describe(const SurfaceDiagnosis& d) {
  std::vector<std::string> parts;
  std::string advice;
  const auto say = [&](const Defect& defect, const std::string& what, const char* remedy) {
    if (defect.count == 0) return;
    parts.push_back(what + place(defect));
    if (advice.empty()) advice = remedy;
  };
  say(d.open_edges,
      fmt::format("it is open, with {} around {}", plural(d.open_edges.count, "open edge", "open edges"),
                  plural(d.boundary_loops, "hole", "holes")),
      "close the holes");
  say(d.non_manifold_edges,
      fmt::format("it is non-manifold: {} with more than two faces",
                  plural(d.non_manifold_edges.count, "edge", "edges")),
      "leave two faces at every edge");
  say(d.crossings, fmt::format("it crosses itself in {}", plural(d.crossings.count, "pair of faces", "pairs of faces")),
      "pull the faces apart or join them into one outer surface");
  say(d.inside_out,
      d.components == d.inside_out.count
          ? std::string("it is inside out (its faces look inwards)")
          : fmt::format("{} inside out", plural(d.inside_out.count, "part of it is", "parts of it are")),
      "flip its faces");
  say(d.flipped_edges,
      fmt::format("its faces look to both sides: their orientation changes across {}",
                  plural(d.flipped_edges.count, "edge", "edges")),
      "make the orientation consistent");
  say(d.non_manifold_vertices,
      fmt::format("{} where parts of it only touch", plural(d.non_manifold_vertices.count, "vertex", "vertices")),
      "separate the parts or join them by faces");
  say(d.nested, fmt::format("{} inside another one", plural(d.nested.count, "closed part lies", "closed parts lie")),
      "remove it, or flip its faces to make a cavity");
  say(d.duplicates, fmt::format("{} twice", plural(d.duplicates.count, "face is there", "faces are there")),
      "remove the copies");
  say(d.zero_area, plural(d.zero_area.count, "face has no area", "faces have no area"), "remove or repair them");
  say(d.unused_vertices, plural(d.unused_vertices.count, "vertex belongs to no face", "vertices belong to no face"),
      "remove them");
  if (parts.empty()) return d.components == 0 ? "the surface has no faces" : "";
  std::string text = "the surface bounds no solid: ";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  }
  return text + "; " + advice;
}

}  // namespace softreel::assets
