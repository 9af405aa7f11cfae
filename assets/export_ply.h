#pragma once
// PLY (binary, little endian): positions, smooth normals and triangles of one frame.
#include <filesystem>
#include <span>

#include "sim/mesh.h"

namespace softreel::assets {

/// Writes float positions [m] and area-weighted normals. `vertices` x `triangles` as in sim::TriangleMesh; a vertex
/// that no triangle uses gets the normal 0 1 0. Throws UserError(kOutput).
void write_ply(const std::filesystem::path& file, std::span<const sim::Vec3> vertices,
               std::span<const sim::Triangle> triangles);

}  // namespace softreel::assets
