// TetGen's .node and .ele (TetGen manual 1.5, chapter 5).
#include <fmt/format.h>

#include <iterator>

#include "assets/raw_tets.h"
#include "assets/text_scanner.h"

namespace softreel::assets {

RawTets read_tetgen(std::string_view node, const std::string& node_file, std::string_view ele,
                    const std::string& ele_file) {
  RawTets raw;
  TextScanner nodes(node, node_file, '#');
  const std::size_t count = nodes.count("the number of nodes", 8);  // "1 0 0 0\n"
  if (nodes.integer("the dimension") != 3) nodes.fail("its dimension is not 3");
  const std::int64_t extra =
      nodes.integer("the number of attributes") + (nodes.integer("the marker flag") != 0 ? 1 : 0);
  if (extra < 0 || extra > 1000) nodes.fail("its number of attributes makes no sense");
  raw.nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = nodes.integer("a node's number");
    const double x = nodes.number("x"), y = nodes.number("y"), z = nodes.number("z");
    for (std::int64_t k = 0; k < extra; ++k) nodes.word("a node's attribute");
    raw.add_node(number, {x, y, z}, node_file);
  }
  TextScanner elements(ele, ele_file, '#');
  const std::size_t tets = elements.count("the number of tetrahedra", 10);  // "1 1 2 3 4\n"
  const std::int64_t corners = elements.integer("the nodes per tetrahedron");
  if (corners != 4) elements.fail(fmt::format("has {} nodes per tetrahedron; save it with 4", corners));
  const std::int64_t attributes = elements.integer("the number of attributes");
  if (attributes < 0 || attributes > 1000) elements.fail("its number of attributes makes no sense");
  raw.tets.reserve(tets);
  for (std::size_t i = 0; i < tets; ++i) {
    elements.integer("a tetrahedron's number");
    std::array<std::int64_t, 4> t;
    for (std::int64_t& v : t) v = elements.integer("a node of a tetrahedron");
    for (std::int64_t k = 0; k < attributes; ++k) elements.word("a tetrahedron's attribute");
    raw.tets.push_back(t);
  }
  return raw;
}

std::string format_tetgen_node(const sim::TetMesh& mesh) {
  std::string text = fmt::format("{} 3 0 0\n", mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const sim::Vec3& p = mesh.vertices[i];
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", i, p.x(), p.y(), p.z());
  }
  return text;
}

std::string format_tetgen_ele(const sim::TetMesh& mesh) {
  std::string text = fmt::format("{} 4 0\n", mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const sim::Tet& t = mesh.tets[i];
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {}\n", i, t[0], t[1], t[2], t[3]);
  }
  return text;
}

}  // namespace softreel::assets
