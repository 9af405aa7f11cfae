#pragma once
// Colours with smooth borders: the mesh is cut along them.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "assets/generate/shape.h"
#include "sim/mesh.h"

namespace softreel::generate {

struct Paint {
  std::string name;
  std::array<double, 3> color;  ///< linear RGB
  double roughness = 0.5;
  Field region;  ///< negative where this paint goes; the first of a list has none: everywhere
};

/// Which paint (index) every triangle has; later paints cover earlier ones. Cuts edges that cross a border, vertices
/// close to one move onto it. `surface` is the field of the mesh.
std::vector<int> apply_paints(sim::TriangleMesh& mesh, const Field& surface, const std::vector<Paint>& paints);

/// OBJ with an MTL of the same stem beside it, one group per paint. `paint_of` per triangle.
void write_painted_obj(const std::filesystem::path& file, const sim::TriangleMesh& mesh,
                       const std::vector<int>& paint_of, const std::vector<Paint>& paints);

}  // namespace softreel::generate
