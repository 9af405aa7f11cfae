// Writing Gmsh's .msh: one volume, its nodes and tetrahedra numbered from 1.
#include <fmt/format.h>

#include <cstdint>
#include <iterator>

#include "assets/raw_tets.h"

namespace softreel::assets {
namespace {

template <class T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string header(const char* version, bool binary) {
  std::string out = fmt::format("$MeshFormat\n{} {} 8\n", version, binary ? 1 : 0);
  if (binary) {
    put<std::int32_t>(out, 1);  // byte order
    out += '\n';
  }
  return out + "$EndMeshFormat\n";
}

std::string ascii22(const sim::TetMesh& mesh) {
  std::string text = header("2.2", false) + fmt::format("$Nodes\n{}\n", mesh.vertices.size());
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const sim::Vec3& p = mesh.vertices[i];
    fmt::format_to(out, "{} {} {} {}\n", i + 1, p.x(), p.y(), p.z());
  }
  fmt::format_to(out, "$EndNodes\n$Elements\n{}\n", mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const sim::Tet& t = mesh.tets[i];
    fmt::format_to(out, "{} 4 2 1 1 {} {} {} {}\n", i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  return text + "$EndElements\n";
}

std::string binary22(const sim::TetMesh& mesh) {
  std::string out = header("2.2", true) + fmt::format("$Nodes\n{}\n", mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    put(out, static_cast<std::int32_t>(i + 1));
    for (int k = 0; k < 3; ++k) put(out, mesh.vertices[i][k]);
  }
  out += fmt::format("\n$EndNodes\n$Elements\n{}\n", mesh.tets.size());
  put<std::int32_t>(out, 4);  // type, elements of this block, tags
  put(out, static_cast<std::int32_t>(mesh.tets.size()));
  put<std::int32_t>(out, 2);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    put(out, static_cast<std::int32_t>(i + 1));
    put<std::int32_t>(out, 1);
    put<std::int32_t>(out, 1);
    for (const int v : mesh.tets[i]) put<std::int32_t>(out, v + 1);
  }
  return out + "\n$EndElements\n";
}

std::string ascii41(const sim::TetMesh& mesh) {
  const std::size_t n = mesh.vertices.size(), m = mesh.tets.size();
  std::string text = header("4.1", false) + fmt::format("$Nodes\n1 {} 1 {}\n3 1 0 {}\n", n, n, n);
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < n; ++i) fmt::format_to(out, "{}\n", i + 1);
  for (const sim::Vec3& p : mesh.vertices) fmt::format_to(out, "{} {} {}\n", p.x(), p.y(), p.z());
  fmt::format_to(out, "$EndNodes\n$Elements\n1 {} 1 {}\n3 1 4 {}\n", m, m, m);
  for (std::size_t i = 0; i < m; ++i) {
    const sim::Tet& t = mesh.tets[i];
    fmt::format_to(out, "{} {} {} {} {}\n", i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  return text + "$EndElements\n";
}

std::string binary41(const sim::TetMesh& mesh) {
  const std::uint64_t n = mesh.vertices.size(), m = mesh.tets.size();
  std::string out = header("4.1", true) + "$Nodes\n";
  for (const std::uint64_t v : {std::uint64_t{1}, n, std::uint64_t{1}, n}) put(out, v);
  for (const std::int32_t v : {3, 1, 0}) put(out, v);
  put(out, n);
  for (std::uint64_t i = 1; i <= n; ++i) put(out, i);
  for (const sim::Vec3& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) put(out, p[k]);
  }
  out += "\n$EndNodes\n$Elements\n";
  for (const std::uint64_t v : {std::uint64_t{1}, m, std::uint64_t{1}, m}) put(out, v);
  for (const std::int32_t v : {3, 1, 4}) put(out, v);
  put(out, m);
  for (std::uint64_t i = 0; i < m; ++i) {
    put(out, i + 1);
    for (const int v : mesh.tets[i]) put(out, static_cast<std::uint64_t>(v + 1));
  }
  return out + "\n$EndElements\n";
}

}  // namespace

std::string format_gmsh(const sim::TetMesh& mesh, bool binary, MshVersion version) {
  if (version == MshVersion::k22) return binary ? binary22(mesh) : ascii22(mesh);
  return binary ? binary41(mesh) : ascii41(mesh);
}

}  // namespace softreel::assets
