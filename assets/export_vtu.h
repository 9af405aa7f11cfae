#pragma once
// VTK's unstructured grids (.vtu, raw appended data) and the list of a clip's frames (.pvd), as ParaView opens them.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/mesh.h"

namespace softreel::assets {

/// Cells of one frame: tetrahedra, triangles, or both.
struct VtuFrame {
  std::span<const sim::Vec3> vertices;       ///< [m]
  std::span<const sim::Tet> tets;            ///< over vertices
  std::span<const sim::Triangle> triangles;  ///< over vertices
  std::span<const sim::Vec3> velocities;     ///< per vertex [m/s], or empty
  std::span<const double> values = {};       ///< of a field, per vertex, as "value"; or empty
  std::span<const double> rates = {};        ///< of a wave, per vertex, as "rate"; or empty
};

/// Doubles, 32-bit connectivity. Throws UserError(kOutput).
void write_vtu(const std::filesystem::path& file, const VtuFrame& frame);

struct PvdEntry {
  double time = 0;             ///< [s]
  std::filesystem::path file;  ///< relative to the .pvd file
  int part = 0;                ///< body number, where one time has several files
  std::string name;            ///< of the body; may be empty
};

/// The time series of a clip. Throws UserError(kOutput).
void write_pvd(const std::filesystem::path& file, const std::vector<PvdEntry>& entries);

}  // namespace softreel::assets
