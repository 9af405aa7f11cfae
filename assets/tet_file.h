#pragma once
// Tetrahedral meshes in files: TetGen .node/.ele, Gmsh .msh (2.2 and 4.1, ASCII and binary), Medit .mesh.
#include <filesystem>
#include <string>

#include "assets/mesh_options.h"
#include "sim/mesh.h"

namespace softreel::assets {

struct TetFile {
  sim::TetMesh mesh;         ///< [m]; positive orientation, no unused vertex
  int flipped = 0;           ///< tets whose orientation was negative in the file
  int dropped_nodes = 0;     ///< nodes that no tet uses
  int dropped_elements = 0;  ///< points, lines, triangles: left out
};

/// Whether the extension is one of a tetrahedral file (.msh, .mesh, .node, .ele).
bool is_tet_file(const std::filesystem::path& file);

/// Reads linear tetrahedra. Of .node and .ele either name may be given.
/// Throws UserError(kInput) with the line (text formats) when the file is missing, truncated, out of range, not finite,
/// without tetrahedra, or has one without volume. Counts are held against the size of the file before memory is asked
/// for.
TetFile read_tet_file(const std::filesystem::path& file, const MeshOptions& options = {});

enum class MshVersion { k22, k41 };

/// Throws UserError(kUsage) when `write_tet_file` does not know the extension; for asking before the work.
void check_tet_output(const std::filesystem::path& file);

/// Writes .msh, .mesh, .vtu (by export_vtu.h), or .node/.ele (both), chosen by the extension; all coordinates round
/// trip exactly. `binary` and `version` concern .msh. Throws UserError(kUsage) for another extension, kOutput when it
/// cannot be written.
void write_tet_file(const std::filesystem::path& file, const sim::TetMesh& mesh, bool binary = true,
                    MshVersion version = MshVersion::k41);

}  // namespace softreel::assets
