#include "assets/export_vtu.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <stdexcept>

#include "assets/atomic_file.h"

namespace softreel::assets {
namespace {

constexpr std::uint8_t kVtkTriangle = 5, kVtkTetra = 10;

/// The raw blocks behind the XML: a 64-bit length in front of each.
class Appended {
 public:
  /// Adds a block and returns its DataArray element.
  std::string array(const char* attributes, const void* data, std::size_t bytes) {
    const std::string xml =
        fmt::format("        <DataArray {} format=\"appended\" offset=\"{}\"/>\n", attributes, blocks_.size());
    const std::uint64_t length = bytes;
    blocks_.append(reinterpret_cast<const char*>(&length), sizeof length);
    if (bytes > 0) blocks_.append(static_cast<const char*>(data), bytes);
    return xml;
  }
  const std::string& blocks() const { return blocks_; }

 private:
  std::string blocks_;
};

struct Cells {
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;

  template <class Cell>
  void add(std::span<const Cell> cells, std::uint8_t type) {
    for (const Cell& c : cells) {
      connectivity.insert(connectivity.end(), c.begin(), c.end());
      offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
      types.push_back(type);
    }
  }
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const VtuFrame& frame) {
  for (const std::size_t size : {frame.velocities.size(), frame.values.size(), frame.rates.size()})
    if (size != 0 && size != frame.vertices.size())
      throw std::logic_error("write_vtu: one velocity, value or rate per vertex, or none");
  Cells cells;
  cells.add(frame.tets, kVtkTetra);
  cells.add(frame.triangles, kVtkTriangle);
  Appended data;
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n";
  xml += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", frame.vertices.size(),
                     cells.types.size());
  if (!frame.velocities.empty()) {
    xml += "      <PointData Vectors=\"velocity\">\n";
    xml += data.array("type=\"Float64\" Name=\"velocity\" NumberOfComponents=\"3\"", frame.velocities.data(),
                      frame.velocities.size_bytes());
    xml += "      </PointData>\n";
  }
  if (!frame.values.empty()) {
    xml += "      <PointData Scalars=\"value\">\n";
    xml += data.array("type=\"Float64\" Name=\"value\"", frame.values.data(), frame.values.size_bytes());
    if (!frame.rates.empty())
      xml += data.array("type=\"Float64\" Name=\"rate\"", frame.rates.data(), frame.rates.size_bytes());
    xml += "      </PointData>\n";
  }
  xml += "      <Points>\n";
  xml += data.array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", frame.vertices.data(),
                    frame.vertices.size_bytes());
  xml += "      </Points>\n      <Cells>\n";
  xml += data.array("type=\"Int32\" Name=\"connectivity\"", cells.connectivity.data(), 4 * cells.connectivity.size());
  xml += data.array("type=\"Int32\" Name=\"offsets\"", cells.offsets.data(), 4 * cells.offsets.size());
  xml += data.array("type=\"UInt8\" Name=\"types\"", cells.types.data(), cells.types.size());
  xml += "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  AtomicFile out(file);
  out.write(xml);
  out.write(data.blocks());
  out.write("\n  </AppendedData>\n</VTKFile>\n");
  out.commit();
}

void write_pvd(const std::filesystem::path& file, const std::vector<PvdEntry>& entries) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const PvdEntry& e : entries) {
    fmt::format_to(std::back_inserter(xml),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", e.time, e.part,
                   escaped(e.name), escaped(e.file.generic_string()));
  }
  write_file_atomically(file, xml + "  </Collection>\n</VTKFile>\n");
}

}  // namespace softreel::assets
