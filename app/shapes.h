#pragma once
// Everything that a scene's bodies need from files, loaded and placed: before anything is simulated or drawn.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/balls_and_rods.h"
#include "assets/scene.h"
#include "assets/surface_import.h"
#include "sim/mesh.h"

namespace softreel::app {

/// The picture's side of a body. Positions are vertices [0, position_count) of the body.
struct BodySurface {
  assets::ImportedSurface surface;  ///< `welded` at rest, placed
  int position_count = 0;
};

struct SolidShape {
  sim::TetMesh rest;  ///< placed [m]
  BodySurface drawn;
};

/// Of a cloth or field.
struct ClothShape {
  sim::TriangleMesh rest;  ///< placed [m]
  BodySurface drawn;
};

struct SpringShape {
  std::vector<sim::Vec3> rest;            ///< placed [m]
  std::vector<std::array<int, 2>> edges;  ///< over `rest`
  std::optional<BallsAndRods> drawn;      ///< if visible
};

struct Shapes {
  std::vector<SolidShape> soft;                      ///< as scene.soft
  std::vector<ClothShape> cloth;                     ///< as scene.cloth
  std::vector<SpringShape> springs;                  ///< as scene.springs
  std::vector<ClothShape> fields;                    ///< as scene.fields
  std::vector<std::optional<ClothShape>> colliders;  ///< as scene.colliders; nothing for simple shapes
  std::vector<std::string> notes;  ///< what the user should know (textures not found, triangles left out)
  double tetrahedralize_seconds = 0;
  bool used_tetgen = false;      ///< a surface had to be filled
  bool tets_from_cache = false;  ///< and all of them were in the cache
};

/// Loads, places and tetrahedralizes. `cache_folder`: for tetrahedra, empty for none. Throws UserError.
Shapes load_shapes(const assets::Scene& scene, const std::filesystem::path& cache_folder);

/// Only those of the fields.
void load_fields(const assets::Scene& scene, Shapes& shapes);

/// Mesh options of a scene's mesh source.
assets::MeshOptions mesh_options(const assets::MeshSource& source);

}  // namespace softreel::app
