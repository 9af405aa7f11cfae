#include "app/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/interrupt.h"
#include "app/placement.h"
#include "assets/tet_file.h"
#include "assets/tetrahedralize.h"
#include "sim/grids.h"
#include "sim/motion.h"

namespace softreel::app {
namespace {

assets::ImportedSurface import(const assets::Scene& scene, const assets::MeshSource& source,
                               std::vector<std::string>& notes) {
  assets::ImportLimits limits;
  limits.poll = stop_if_interrupted;
  assets::ImportedSurface s = assets::import_surface(scene.asset_path(source.path), mesh_options(source), limits);
  for (const std::string& name : s.missing_textures)
    notes.push_back(fmt::format("{}: texture '{}' was not found; drawn without", source.path, name));
  if (s.dropped_degenerate > 0)
    notes.push_back(fmt::format("{}: {} triangles without area left out", source.path, s.dropped_degenerate));
  return s;
}

void place_surface(const assets::Transform& transform, assets::ImportedSurface& surface) {
  place(transform, surface.welded.vertices);
  const Eigen::Matrix3f R = sim::euler_xyz(transform.rotate).cast<float>();
  const Eigen::Vector3f inverse_scale = transform.scale.cwiseInverse().cast<float>();
  for (Eigen::Vector3f& n : surface.normals) n = (R * inverse_scale.cwiseProduct(n)).normalized();
}

/// Gmsh and block meshes bring no surface of their own: the boundary is drawn.
BodySurface boundary_surface(const sim::TetMesh& mesh) {
  BodySurface body;
  body.surface = assets::surface_from_mesh({mesh.vertices, sim::boundary_triangles(mesh)});
  body.position_count = static_cast<int>(mesh.vertices.size());
  return body;
}

SolidShape load_solid(const assets::Scene& scene, const assets::SoftBody& soft,
                      const std::filesystem::path& cache_folder, Shapes& shapes) {
  SolidShape shape;
  const bool surface = soft.mesh.path.empty() ? false : !assets::is_tet_file(scene.asset_path(soft.mesh.path));
  if (!surface) {
    if (soft.block)
      shape.rest =
          sim::block_of_tets(soft.block->size, soft.block->cells[0], soft.block->cells[1], soft.block->cells[2]);
    else
      shape.rest = assets::read_tet_file(scene.asset_path(soft.mesh.path), mesh_options(soft.mesh)).mesh;
    scale_about_pivot(soft.transform, shape.rest.vertices);
    place(soft.transform, shape.rest.vertices);
    shape.drawn = boundary_surface(shape.rest);
    return shape;
  }
  shape.drawn.surface = import(scene, soft.mesh, shapes.notes);
  sim::TriangleMesh& welded = shape.drawn.surface.welded;
  scale_about_pivot(soft.transform, welded.vertices);
  assets::TetrahedralizeOptions options;
  options.quality = soft.tetrahedralize.quality;
  options.max_volume = soft.tetrahedralize.max_volume.value_or(0.0);
  options.seconds = soft.tetrahedralize.time_limit;
  options.poll = stop_if_interrupted;
  const auto start = std::chrono::steady_clock::now();
  assets::CachedTets tets =
      assets::tetrahedralize_cached(welded, scene.asset_path(soft.mesh.path).string(), options, cache_folder);
  shapes.tetrahedralize_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  shapes.tets_from_cache = tets.from_cache && (!shapes.used_tetgen || shapes.tets_from_cache);
  shapes.used_tetgen = true;
  shape.rest = std::move(tets.mesh);
  place(soft.transform, shape.rest.vertices);
  place_surface(soft.transform, shape.drawn.surface);
  shape.drawn.position_count = static_cast<int>(welded.vertices.size());
  return shape;
}

/// Of a cloth, field or mesh collider.
template <class Sheet>
ClothShape load_sheet(const assets::Scene& scene, const Sheet& sheet, Shapes& shapes) {
  ClothShape shape;
  bool made = false;
  if constexpr (requires { sheet.grid; }) {
    made = sheet.grid.has_value();
    if (made)
      shape.drawn.surface = assets::surface_from_mesh(
          sim::grid_sheet(sheet.grid->size[0], sheet.grid->size[1], sheet.grid->cells[0], sheet.grid->cells[1]));
  }
  if (!made) shape.drawn.surface = import(scene, sheet.mesh, shapes.notes);
  scale_about_pivot(sheet.transform, shape.drawn.surface.welded.vertices);
  place_surface(sheet.transform, shape.drawn.surface);
  shape.rest = shape.drawn.surface.welded;
  shape.drawn.position_count = static_cast<int>(shape.rest.vertices.size());
  return shape;
}

/// One number for all, or one for each.
double of_each(const std::vector<double>& list, size_t i) { return list.size() == 1 ? list[0] : list[i]; }

/// A tenth of the mean edge, larger for more mass (balls of one density).
std::vector<double> ball_radii(const assets::SpringBody& body, const SpringShape& shape) {
  double edge = 0, mass = 0;
  const size_t n = shape.rest.size();
  for (const auto& [i, j] : shape.edges)
    edge += (shape.rest[static_cast<size_t>(i)] - shape.rest[static_cast<size_t>(j)]).norm();
  edge = shape.edges.empty() ? 0.5 : edge / static_cast<double>(shape.edges.size());
  for (size_t i = 0; i < n; ++i) mass += of_each(body.masses, i) / static_cast<double>(n);
  std::vector<double> radii;
  for (size_t i = 0; i < n; ++i)
    radii.push_back(body.radius.empty() ? 0.1 * edge * std::cbrt(of_each(body.masses, i) / mass)
                                        : of_each(body.radius, i));
  return radii;
}

SpringShape load_springs(const assets::SpringBody& body, Shapes& shapes) {
  SpringShape shape;
  shape.rest = body.points;
  shape.edges = body.edges;
  if (body.chain) {
    const int links = body.chain->links;
    for (int i = 0; i <= links; ++i) {
      const double s = static_cast<double>(i) / links;
      shape.rest.push_back((1 - s) * body.chain->from + s * body.chain->to);
      if (i > 0) shape.edges.push_back({i - 1, i});
    }
  }
  scale_about_pivot(body.transform, shape.rest);
  place(body.transform, shape.rest);
  std::vector<bool> joined(shape.rest.size(), false);
  for (const auto& [i, j] : shape.edges) joined[static_cast<size_t>(i)] = joined[static_cast<size_t>(j)] = true;
  if (const auto alone = std::count(joined.begin(), joined.end(), false); alone > 0)
    shapes.notes.push_back(fmt::format("springs '{}': {} of {} points {} joined to nothing", body.name, alone,
                                       joined.size(), alone == 1 ? "is" : "are"));
  if (body.visible) {
    const std::vector<double> radii = ball_radii(body, shape);
    shape.drawn.emplace(shape.rest, shape.edges, radii,
                        body.edge_radius.value_or(*std::min_element(radii.begin(), radii.end()) / 3));
  }
  return shape;
}

}  // namespace

assets::MeshOptions mesh_options(const assets::MeshSource& source) {
  assets::MeshOptions options;
  options.unit = source.unit;
  options.up = source.up == assets::UpAxis::kX ? 'x' : source.up == assets::UpAxis::kZ ? 'z' : 'y';
  options.size = source.size;
  return options;
}

Shapes load_shapes(const assets::Scene& scene, const std::filesystem::path& cache_folder) {
  Shapes shapes;
  for (const assets::SoftBody& soft : scene.soft) shapes.soft.push_back(load_solid(scene, soft, cache_folder, shapes));
  for (const assets::Cloth& cloth : scene.cloth) shapes.cloth.push_back(load_sheet(scene, cloth, shapes));
  for (const assets::SpringBody& body : scene.springs) shapes.springs.push_back(load_springs(body, shapes));
  for (const assets::Collider& c : scene.colliders) {
    shapes.colliders.emplace_back();
    if (c.shape == assets::ColliderShape::kMesh) shapes.colliders.back() = load_sheet(scene, c, shapes);
  }
  load_fields(scene, shapes);
  return shapes;
}

void load_fields(const assets::Scene& scene, Shapes& shapes) {
  for (const assets::Field& field : scene.fields) shapes.fields.push_back(load_sheet(scene, field, shapes));
}

}  // namespace softreel::app
