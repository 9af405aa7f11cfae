// Gmsh's .msh, versions 2.2 and 4.1, ASCII and binary (Gmsh reference manual, "MSH file format").
#include <fmt/format.h>

#include <array>

#include "assets/gmsh_stream.h"
#include "assets/raw_tets.h"

namespace softreel::assets {
namespace {

constexpr std::int64_t kLinearTet = 4;

/// Nodes of element types 1 .. 31.
constexpr std::array<int, 32> kNodesOfType = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                              8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

int nodes_of_type(const GmshStream& in, std::int64_t type) {
  if (type < 1 || type > 31) in.fail(fmt::format("an element is of type {}, which is not known here", type));
  switch (type) {
    case 11:
    case 29:
    case 30:
    case 31:
      in.fail("holds tetrahedra of higher order; save them with element order 1");
    case 5:
    case 6:
    case 7:
    case 12:
    case 13:
    case 14:
    case 17:
    case 18:
    case 19:
      in.fail("holds hexahedra, prisms or pyramids; only tetrahedra are read");
    default:
      return kNodesOfType[static_cast<std::size_t>(type)];
  }
}

/// The nodes of one element: kept when it is a tetrahedron, `next` reads one of them.
template <class Next>
void read_element(RawTets& raw, std::int64_t type, int nodes, Next&& next) {
  std::array<std::int64_t, 4> t = {};
  for (int k = 0; k < nodes; ++k) {
    const std::int64_t v = next();
    if (k < 4) t[static_cast<std::size_t>(k)] = v;
  }
  if (type == kLinearTet) {
    raw.tets.push_back(t);
  } else {
    ++raw.dropped_elements;
  }
}

void read_nodes2(GmshStream& in, RawTets& raw, const std::string& file) {
  const std::size_t count = in.text_count("the number of nodes", 8, 28);
  raw.nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = in.int32("a node's number");
    const double x = in.number("x"), y = in.number("y"), z = in.number("z");
    raw.add_node(number, {x, y, z}, file);
  }
}

void read_elements2(GmshStream& in, RawTets& raw) {
  const auto tags_of = [&](std::int64_t tags) {
    if (tags < 0 || tags > 1000) in.fail(fmt::format("an element has {} tags", tags));
    return tags;
  };
  const auto next = [&] { return in.int32("a node of an element"); };
  const std::size_t count = in.text_count("the number of elements", 6, 8);
  for (std::size_t done = 0; done < count;) {
    std::int64_t type, tags, block = 1;
    if (in.binary()) {
      type = in.int32("an element's type");
      block = in.int32("the elements of a block");
      tags = tags_of(in.int32("the number of tags"));
      if (block < 1 || static_cast<std::uint64_t>(block) > count - done) in.fail("a block of elements is too long");
    } else {
      in.int32("an element's number");
      type = in.int32("an element's type");
      tags = tags_of(in.int32("the number of tags"));
    }
    const int nodes = nodes_of_type(in, type);
    for (std::int64_t i = 0; i < block; ++i) {
      if (in.binary()) in.int32("an element's number");
      for (std::int64_t k = 0; k < tags; ++k) in.int32("a tag");
      read_element(raw, type, nodes, next);
    }
    done += static_cast<std::size_t>(block);
  }
}

void read_nodes4(GmshStream& in, RawTets& raw, const std::string& file) {
  const std::size_t blocks = in.count("the number of node blocks", true, 8, 20);
  raw.nodes.reserve(in.count("the number of nodes", true, 2, 24));
  in.size("the smallest node number");
  in.size("the largest node number");
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::int64_t dimension = in.int32("an entity's dimension");
    in.int32("an entity's number");
    const bool parametric = in.int32("the parametric flag") != 0;
    if (dimension < 0 || dimension > 3) in.fail("an entity's dimension is not 0 to 3");
    const std::size_t count = in.count("the nodes of a block", true, 8, 32);
    std::vector<std::int64_t> numbers(count);
    for (std::int64_t& n : numbers) n = in.size("a node's number");
    for (const std::int64_t n : numbers) {
      const double x = in.number("x"), y = in.number("y"), z = in.number("z");
      for (std::int64_t k = 0; parametric && k < dimension; ++k) in.number("a parameter");
      raw.add_node(n, {x, y, z}, file);
    }
  }
}

void read_elements4(GmshStream& in, RawTets& raw) {
  const std::size_t blocks = in.count("the number of element blocks", true, 8, 20);
  in.count("the number of elements", true, 2, 16);
  in.size("the smallest element number");
  in.size("the largest element number");
  for (std::size_t b = 0; b < blocks; ++b) {
    in.int32("an entity's dimension");
    in.int32("an entity's number");
    const std::int64_t type = in.int32("an element's type");
    const std::size_t count = in.count("the elements of a block", true, 4, 16);
    if (count == 0) continue;
    const int nodes = nodes_of_type(in, type);
    for (std::size_t i = 0; i < count; ++i) {
      in.size("an element's number");
      read_element(raw, type, nodes, [&] { return in.size("a node of an element"); });
    }
  }
}

}  // namespace

RawTets read_gmsh(std::string_view bytes, const std::string& file) {
  RawTets raw;
  GmshStream in(bytes, file);
  in.read_header();
  for (std::string section = in.next_section(); !section.empty(); section = in.next_section()) {
    if (section == "Nodes") {
      in.version4() ? read_nodes4(in, raw, file) : read_nodes2(in, raw, file);
      in.end_section(section);
    } else if (section == "Elements") {
      in.version4() ? read_elements4(in, raw) : read_elements2(in, raw);
      in.end_section(section);
    } else {
      in.skip_section(section);
    }
  }
  return raw;
}

}  // namespace softreel::assets
