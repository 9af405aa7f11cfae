#pragma once
// Tetrahedra as a file tells them: nodes with numbers of their own.
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "assets/tet_file.h"

namespace softreel::assets {

struct RawTets {
  std::vector<sim::Vec3> nodes;                     ///< file units
  std::unordered_map<std::int64_t, int> number_of;  ///< the file's number -> index into nodes
  std::vector<std::array<std::int64_t, 4>> tets;    ///< the file's numbers
  int dropped_elements = 0;

  /// Throws UserError(kInput, file) when the number was there before.
  void add_node(std::int64_t number, const sim::Vec3& position, const std::string& file);
};

/// One reader per format. `file` is for messages; all throw UserError(kInput).
RawTets read_gmsh(std::string_view bytes, const std::string& file);
RawTets read_medit(std::string_view bytes, const std::string& file);
RawTets read_tetgen(std::string_view node, const std::string& node_file, std::string_view ele,
                    const std::string& ele_file);

/// Text or bytes of one format.
std::string format_gmsh(const sim::TetMesh& mesh, bool binary, MshVersion version);
std::string format_medit(const sim::TetMesh& mesh);
std::string format_tetgen_node(const sim::TetMesh& mesh);
std::string format_tetgen_ele(const sim::TetMesh& mesh);

}  // namespace softreel::assets
