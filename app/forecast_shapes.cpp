#include <fmt/format.h>

#include <cmath>

#include "app/forecast_edges.h"
#include "app/forecast_warnings.h"
#include "assets/tet_quality.h"
#include "sim/catalogue.h"

namespace softreel::app {
namespace {

using sim::Vec3;

void warn_of_slivers(const std::string& name, const sim::TetMesh& mesh, std::vector<std::string>& warnings) {
  // A regular tetrahedron has 1, the corner of a cube 0.73, the worst that TetGen leaves in good surfaces about 0.1.
  constexpr double kSliver = 0.03;
  int slivers = 0;
  size_t worst = 0;
  double least = kSliver;
  for (size_t t = 0; t < mesh.tets.size(); ++t) {
    const double ratio = assets::radius_ratio(mesh, mesh.tets[t]);
    if (ratio >= kSliver) continue;
    ++slivers;
    if (ratio >= least) continue;
    least = ratio;
    worst = t;
  }
  if (slivers == 0) return;
  Vec3 middle = Vec3::Zero();
  for (int v : mesh.tets[worst]) middle += mesh.vertices[static_cast<size_t>(v)] / 4;
  warnings.push_back(fmt::format(
      "soft '{}': {} of {} tetrahedra {} nearly flat; the worst is number {} near ({:.3g}, {:.3g}, {:.3g}), radius "
      "ratio {:.2g} (regular: 1). They stiffen the body and turn inside out first; a surface without tiny or needle-"
      "like triangles, or another tetrahedralize.quality, avoids them",
      name, slivers, mesh.tets.size(), slivers == 1 ? "is" : "are", worst, middle.x(), middle.y(), middle.z(), least));
}

void warn_of_locking(const assets::SoftBody& soft, std::vector<std::string>& warnings) {
  constexpr double kLocking = 0.48;
  const double nu = soft.material.poisson;
  if (nu < kLocking || !sim::solid_traits(soft.material.model).volume_term) return;
  warnings.push_back(fmt::format(
      "soft '{}': poisson = {:g} keeps the volume of every linear tetrahedron ({:.0f} times stiffer than shear), so "
      "that the body hardly bends; 0.45 looks much the same and bends",
      soft.name, nu, 2 * nu / (1 - 2 * nu)));
}

void warn_of_thickness(const assets::Cloth& cloth, const Edges& edges, std::vector<std::string>& warnings) {
  // Thin sheets: the theory of membranes leaves out what is of the order thickness over length.
  if (cloth.model != assets::ClothModel::kMembrane || cloth.material.thickness <= 0.5 * edges.median) return;
  warnings.push_back(
      fmt::format("cloth '{}': thickness = {:g} m is no thin sheet on edges of {:.3g} m; as a soft body it would be "
                  "a solid",
                  cloth.name, cloth.material.thickness, edges.median));
}

}  // namespace

void warn_of_shapes(const assets::Scene& scene, const Shapes& shapes, std::vector<std::string>& warnings) {
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    warn_of_slivers(scene.soft[i].name, shapes.soft[i].rest, warnings);
    warn_of_locking(scene.soft[i], warnings);
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i) {
    const sim::TriangleMesh& mesh = shapes.cloth[i].rest;
    warn_of_thickness(scene.cloth[i], edges_of(mesh.vertices, mesh.triangles), warnings);
  }
}

namespace {

/// How far a chord between two vertices that lie at `radius` from the middle dips below it [m].
double sagitta(double radius, double chord) {
  const double half = 0.5 * chord;
  return half < radius ? radius - std::sqrt(radius * radius - half * half) : radius;
}

/// Edges that bend around something round lie inside it between their vertices.
void warn_of_dips(const Meeting& m, double distance, std::vector<std::string>& warnings) {
  const assets::ColliderShape shape = m.collider->shape;
  if (shape != assets::ColliderShape::kSphere && shape != assets::ColliderShape::kCapsule) return;
  const double radius = inner_radius(*m.collider), longest = m.body->edges.longest;
  // Vertices stand off by the contact distance at most; what dips hardly further is not worth a word.
  const double dip = sagitta(radius + distance, longest) - distance;
  if (dip <= 2 * distance) return;
  warnings.push_back(
      fmt::format("where '{}' bends around collider '{}', its edges, up to {:.3g} m long, dip about {:.2g} mm into it: "
                  "only vertices "
                  "touch simple shapes; a finer mesh, a larger contact.distance ({:.2g}), or a ball of triangles "
                  "(shape = \"mesh\") "
                  "keeps them off",
                  m.body->body->name, m.collider->name, longest, 1e3 * dip, sagitta(radius, longest)));
}

}  // namespace

void warn_of_gaps(const std::vector<Meeting>& meetings, double distance, std::vector<std::string>& warnings) {
  for (const Meeting& m : meetings) {
    const double width = 2 * inner_radius(*m.collider);
    // A ball of this width fits between vertices so far apart.
    if (width >= m.body->edges.longest) warn_of_dips(m, distance, warnings);
    if (width <= 0 || width >= m.body->edges.longest) continue;
    warnings.push_back(fmt::format(
        "collider '{}' is {:.3g} m thin, edges of '{}' are up to {:.3g} m long: only vertices touch colliders, so it "
        "can slip through between them; a finer mesh holds",
        m.collider->name, width, m.body->body->name, m.body->edges.longest));
  }
}

}  // namespace softreel::app
