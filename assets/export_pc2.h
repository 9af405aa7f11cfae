#pragma once
// PC2 point caches: one file with the moving points of a clip, applied in Blender by a Mesh Cache modifier on the rest
// mesh.
#include <filesystem>
#include <span>

#include "assets/atomic_file.h"
#include "sim/mesh.h"

namespace softreel::assets {

/// Writes a clip frame by frame; the file appears with `finish`.
/// Format: "POINTCACHE2\0", int32 version 1, int32 points, float start, float step, int32 samples, then float xyz.
class Pc2Writer {
 public:
  /// `frames` must be what follows. `start` and `step` count in frames, as Blender takes them.
  Pc2Writer(const std::filesystem::path& file, int points, int frames, float start = 1, float step = 1);
  void add(std::span<const sim::Vec3> vertices);  ///< `points` positions [m]
  void finish();                                  ///< after the last frame

 private:
  AtomicFile file_;
  int points_, frames_, added_ = 0;
};

/// The rest mesh that goes with a PC2 as OBJ: its vertices in the order of the cache. Blender: import with
/// "Keep Vertex Order", axes Y up. Throws UserError(kOutput).
void write_obj(const std::filesystem::path& file, std::span<const sim::Vec3> vertices,
               std::span<const sim::Triangle> triangles);

}  // namespace softreel::assets
