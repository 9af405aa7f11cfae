#pragma once
// Triangle surfaces from files, through assimp. The physics gets welded vertices; the picture keeps split ones.
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assets/mesh_options.h"
#include "sim/mesh.h"

namespace softreel::assets {

/// A picture that a material names.
struct TextureSource {
  std::filesystem::path file;       ///< absolute; empty: none
  std::vector<std::uint8_t> bytes;  ///< or the encoded picture (PNG, JPEG) out of the mesh file
  bool given() const { return !file.empty() || !bytes.empty(); }
};

/// A range of triangles with one material.
struct SurfacePart {
  std::string name;                                 ///< of the material, or of the mesh; may be empty
  int first_triangle = 0;                           ///< into ImportedSurface::triangles
  int triangle_count = 0;                           ///< > 0
  std::optional<std::array<double, 3>> base_color;  ///< linear RGB in [0, 1]
  std::optional<double> metallic, roughness;        ///< [0, 1], where the file has them
  std::optional<std::array<double, 3>> emission;    ///< linear RGB, >= 0
  TextureSource texture;                            ///< of the base colour, sRGB
  TextureSource normal_texture;                     ///< in tangent space, as glTF
  TextureSource roughness_texture;                  ///< green roughness, blue metallic, as glTF
  TextureSource emission_texture;                   ///< sRGB
};

/// One surface. `triangles[i]` and `welded.triangles[i]` are the same triangle, so
/// position_of[triangles[i][k]] == welded.triangles[i][k].
struct ImportedSurface {
  sim::TriangleMesh welded;              ///< positions [m]; no vertex is unused
  std::vector<int> position_of;          ///< render vertex -> vertex of `welded`
  std::vector<Eigen::Vector2f> uv;       ///< per render vertex, v up (OpenGL), or empty
  std::vector<Eigen::Vector3f> normals;  ///< per render vertex, unit length, from the file, or empty
  std::vector<sim::Triangle> triangles;  ///< over render vertices
  std::vector<SurfacePart> parts;        ///< in order; cover all triangles without overlap; at least one

  std::vector<std::string> missing_textures;  ///< that the file names and nobody finds

  int dropped_degenerate = 0;  ///< triangles with two equal corners or no area at all, left out
  int dropped_other = 0;       ///< points and lines, left out
};

/// Limits of an import; the defaults serve everything a clip can hold.
struct ImportLimits {
  std::size_t file_bytes = std::size_t{2} << 30;
  std::size_t triangles = 20'000'000;
  double seconds = 120;        ///< then the import is stopped
  std::function<void()> poll;  ///< called some 50 times a second; what it throws ends the import
};

/// Reads all meshes of a file with their node transforms, polygons cut into triangles (concave ones too).
/// Vertices nearer than 1e-7 of the longest side of the bounding box become one, in the order of first appearance.
/// Runs in a worker process (see worker.h): a broken file cannot take the program down.
/// Throws UserError(kInput) with the file and a sentence: missing, not a mesh format we read, broken, empty, not
/// finite, too large.
ImportedSurface import_surface(const std::filesystem::path& file, const MeshOptions& options = {},
                               const ImportLimits& limits = {});

/// The same around a surface that is already in memory: one part, no uv, nothing split.
ImportedSurface surface_from_mesh(sim::TriangleMesh mesh);

/// Whether the extension is one that `import_surface` reads.
bool is_surface_file(const std::filesystem::path& file);

/// The extensions that `import_surface` reads, for messages: "obj, ply, ...".
const std::string& surface_extensions();

}  // namespace softreel::assets
