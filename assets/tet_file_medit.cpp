// Medit's .mesh, ASCII (Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253, 2001).
#include <fmt/format.h>

#include <cctype>
#include <iterator>

#include "assets/raw_tets.h"
#include "assets/text_scanner.h"

namespace softreel::assets {
namespace {

bool starts_section(std::string_view word) {
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) && word != "nan" && word != "inf";
}

/// Sections that hold nothing of ours are numbers up to the next word.
void skip_numbers(TextScanner& in) {
  while (!in.at_end() && !starts_section(in.peek())) in.word("a number");
}

void refuse_sections(TextScanner& in, std::string_view section) {
  if (section == "Hexahedra" || section == "Hexaedra" || section == "Prisms" || section == "Pyramids" ||
      section.starts_with("TetrahedraP")) {
    in.fail(fmt::format("holds {}; only linear tetrahedra are read", section));
  }
}

}  // namespace

RawTets read_medit(std::string_view bytes, const std::string& file) {
  RawTets raw;
  TextScanner in(bytes, file, '#');
  if (in.word("MeshVersionFormatted") != "MeshVersionFormatted") {
    in.fail("does not begin with MeshVersionFormatted: no Medit file in ASCII");
  }
  in.integer("the version");
  while (!in.at_end()) {
    const std::string_view section = in.word("a section");
    if (section == "End") break;
    if (!starts_section(section)) in.fail("a section's name should stand here");
    if (section == "Dimension") {
      if (in.integer("the dimension") != 3) in.fail("its dimension is not 3");
    } else if (section == "Vertices") {
      const std::size_t count = in.count("the number of vertices", 8);  // "0 0 0 0\n"
      raw.nodes.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const double x = in.number("x"), y = in.number("y"), z = in.number("z");
        in.integer("a vertex's reference");
        raw.add_node(static_cast<std::int64_t>(raw.nodes.size()) + 1, {x, y, z}, file);
      }
    } else if (section == "Tetrahedra") {
      const std::size_t count = in.count("the number of tetrahedra", 10);  // "1 2 3 4 0\n"
      raw.tets.reserve(raw.tets.size() + count);
      for (std::size_t i = 0; i < count; ++i) {
        std::array<std::int64_t, 4> t;
        for (std::int64_t& v : t) v = in.integer("a vertex of a tetrahedron");
        in.integer("a tetrahedron's reference");
        raw.tets.push_back(t);
      }
    } else {
      refuse_sections(in, section);
      const bool elements = section == "Triangles" || section == "Edges" || section == "Quadrilaterals";
      if (elements) raw.dropped_elements += static_cast<int>(in.count("the number of elements", 2));
      skip_numbers(in);
    }
  }
  return raw;
}

std::string format_medit(const sim::TetMesh& mesh) {
  std::string text = fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", mesh.vertices.size());
  auto out = std::back_inserter(text);
  for (const sim::Vec3& p : mesh.vertices) fmt::format_to(out, "{} {} {} 0\n", p.x(), p.y(), p.z());
  fmt::format_to(out, "Tetrahedra\n{}\n", mesh.tets.size());
  for (const sim::Tet& t : mesh.tets) {
    fmt::format_to(out, "{} {} {} {} 0\n", t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  return text + "End\n";
}

}  // namespace softreel::assets
