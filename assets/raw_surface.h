#pragma once
// A surface as a file tells it: every corner may have a vertex of its own.
#include "assets/blob.h"
#include "assets/surface_import.h"

namespace softreel::assets {

struct RawSurface {
  std::string error;                     ///< why there is none; empty: there is one
  std::vector<sim::Vec3> positions;      ///< file units, node transforms applied
  std::vector<Eigen::Vector2f> uv;       ///< per position, or empty
  std::vector<Eigen::Vector3f> normals;  ///< per position, or empty
  std::vector<sim::Triangle> triangles;
  std::vector<SurfacePart> parts;
  std::vector<std::string> missing_textures;
  std::int64_t dropped_other = 0;
};

/// To and from the bytes that a worker hands back. `read_raw` throws BrokenBlob.
std::string write_raw(const RawSurface& raw);
RawSurface read_raw(std::string_view bytes);

/// Welds positions, joins equal corners, drops what has no area, applies the options.
/// Throws UserError(kInput, name, ...) on coordinates that are not finite and when nothing is left.
ImportedSurface build_surface(RawSurface raw, const std::string& name, const MeshOptions& options);

/// For every position the index of its representative in `first`: the earliest one within `tolerance`. Positions
/// finite.
struct Welding {
  std::vector<int> of;              ///< position -> welded vertex
  std::vector<sim::Vec3> vertices;  ///< in the order of first appearance
};
Welding weld(const std::vector<sim::Vec3>& positions, double tolerance);

}  // namespace softreel::assets
