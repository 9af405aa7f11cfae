#include "app/shapes.h"

#include <fmt/format.h>

#include <chrono>

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

ClothShape load_cloth(const assets::Scene& scene, const assets::Cloth& cloth, Shapes& shapes) {
  ClothShape shape;
  if (cloth.grid)
    shape.drawn.surface = assets::surface_from_mesh(
        sim::grid_sheet(cloth.grid->size[0], cloth.grid->size[1], cloth.grid->cells[0], cloth.grid->cells[1]));
  else
    shape.drawn.surface = import(scene, cloth.mesh, shapes.notes);
  scale_about_pivot(cloth.transform, shape.drawn.surface.welded.vertices);
  place_surface(cloth.transform, shape.drawn.surface);
  shape.rest = shape.drawn.surface.welded;
  shape.drawn.position_count = static_cast<int>(shape.rest.vertices.size());
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
  for (const assets::Cloth& cloth : scene.cloth) shapes.cloth.push_back(load_cloth(scene, cloth, shapes));
  return shapes;
}

}  // namespace softreel::app
