#include "assets/tet_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>

#include "assets/atomic_file.h"
#include "assets/error.h"
#include "assets/export_vtu.h"
#include "assets/raw_tets.h"

namespace softreel::assets {
namespace {

constexpr std::size_t kLimit = std::size_t{4} << 30;  // bytes

std::string extension(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::filesystem::path sibling(std::filesystem::path file, const char* wanted) { return file.replace_extension(wanted); }

RawTets read_raw_tets(const std::filesystem::path& file) {
  const std::string ext = extension(file);
  if (ext == ".node" || ext == ".ele") {
    const auto node = ext == ".node" ? file : sibling(file, ".node");
    const auto ele = ext == ".ele" ? file : sibling(file, ".ele");
    return read_tetgen(read_file(node, kLimit), node.string(), read_file(ele, kLimit), ele.string());
  }
  if (ext == ".msh") return read_gmsh(read_file(file, kLimit), file.string());
  if (ext == ".mesh") return read_medit(read_file(file, kLimit), file.string());
  throw UserError(ErrorKind::kInput, file.string(),
                  "is no tetrahedral file that is read here; these are: .msh, .mesh, .node, .ele");
}

TetFile finish(RawTets raw, const std::string& file, const MeshOptions& options) {
  const auto refuse = [&](const std::string& why) { throw UserError(ErrorKind::kInput, file, why); };
  if (raw.tets.empty()) {
    refuse(fmt::format("holds no tetrahedra ({} points, lines and faces); save the volume elements too",
                       raw.dropped_elements));
  }
  std::vector<std::array<int, 4>> tets(raw.tets.size());
  std::vector<int> number(raw.nodes.size(), -1);
  for (std::size_t i = 0; i < tets.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto found = raw.number_of.find(raw.tets[i][k]);
      if (found == raw.number_of.end()) {
        refuse(fmt::format("tetrahedron {} names node {}, which is not there", i + 1, raw.tets[i][k]));
      }
      tets[i][k] = found->second;
      number[static_cast<std::size_t>(found->second)] = 0;
    }
  }
  TetFile out;
  out.dropped_elements = raw.dropped_elements;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) {
      ++out.dropped_nodes;
      continue;
    }
    number[i] = static_cast<int>(out.mesh.vertices.size());
    out.mesh.vertices.push_back(raw.nodes[i]);
  }
  for (std::size_t i = 0; i < tets.size(); ++i) {
    sim::Tet& t = tets[i];
    for (int& v : t) v = number[static_cast<std::size_t>(v)];
    const auto p = [&](std::size_t k) -> const sim::Vec3& { return out.mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const double volume = sim::tet_volume(p(0), p(1), p(2), p(3));
    if (!(std::abs(volume) > 0) || !std::isfinite(volume)) {
      refuse(fmt::format("tetrahedron {} (near {:.4g}, {:.4g}, {:.4g}) has no volume; repair the mesh", i + 1, p(0).x(),
                         p(0).y(), p(0).z()));
    }
    if (volume < 0) {
      std::swap(t[2], t[3]);
      ++out.flipped;
    }
    out.mesh.tets.push_back(t);
  }
  apply_mesh_options(options, out.mesh.vertices);
  return out;
}

}  // namespace

void RawTets::add_node(std::int64_t number, const sim::Vec3& position, const std::string& file) {
  if (!position.allFinite()) {
    throw UserError(ErrorKind::kInput, file, fmt::format("node {} has a coordinate that is no finite number", number));
  }
  if (!number_of.emplace(number, static_cast<int>(nodes.size())).second) {
    throw UserError(ErrorKind::kInput, file, fmt::format("node {} is there twice", number));
  }
  nodes.push_back(position);
}

bool is_tet_file(const std::filesystem::path& file) {
  const std::string ext = extension(file);
  return ext == ".msh" || ext == ".mesh" || ext == ".node" || ext == ".ele";
}

TetFile read_tet_file(const std::filesystem::path& file, const MeshOptions& options) {
  return finish(read_raw_tets(file), file.string(), options);
}

void check_tet_output(const std::filesystem::path& file) {
  const std::string ext = extension(file);
  if (!is_tet_file(file) && ext != ".vtu") {
    throw UserError(ErrorKind::kUsage, file.string(),
                    fmt::format("'{}' is no tetrahedral format; these are: .msh, .mesh, .vtu, .node, .ele", ext));
  }
}

void write_tet_file(const std::filesystem::path& file, const sim::TetMesh& mesh, bool binary, MshVersion version) {
  check_tet_output(file);
  const std::string ext = extension(file);
  if (ext == ".msh") {
    write_file_atomically(file, format_gmsh(mesh, binary, version));
  } else if (ext == ".mesh") {
    write_file_atomically(file, format_medit(mesh));
  } else if (ext == ".vtu") {
    write_vtu(file, {mesh.vertices, mesh.tets, {}, {}});
  } else if (ext == ".node" || ext == ".ele") {
    write_file_atomically(sibling(file, ".node"), format_tetgen_node(mesh));
    write_file_atomically(sibling(file, ".ele"), format_tetgen_ele(mesh));
  }
}

}  // namespace softreel::assets
