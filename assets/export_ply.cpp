#include "assets/export_ply.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cstdint>

#include "assets/atomic_file.h"

namespace softreel::assets {

void write_ply(const std::filesystem::path& file, std::span<const sim::Vec3> vertices,
               std::span<const sim::Triangle> triangles) {
  std::vector<sim::Vec3> normals(vertices.size(), sim::Vec3::Zero());
  for (const sim::Triangle& t : triangles) {
    const sim::Vec3& a = vertices[static_cast<std::size_t>(t[0])];
    const sim::Vec3 n =
        (vertices[static_cast<std::size_t>(t[1])] - a).cross(vertices[static_cast<std::size_t>(t[2])] - a);
    for (const int v : t) normals[static_cast<std::size_t>(v)] += n;  // its length weighs by area
  }
  AtomicFile out(file);
  out.write(fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices.size()));
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out.write(fmt::format("property float {}\n", name));
  out.write(fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", triangles.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double length = normals[i].norm();
    const sim::Vec3 n = length > 0 ? sim::Vec3(normals[i] / length) : sim::Vec3(0, 1, 0);
    Eigen::Matrix<float, 6, 1> record;
    record << vertices[i].cast<float>(), n.cast<float>();
    out.write(record.data(), sizeof(float) * 6);
  }
  for (const sim::Triangle& t : triangles) {
    const std::uint8_t corners = 3;
    out.write(&corners, 1);
    out.write(t.data(), sizeof t);
  }
  out.commit();
}

}  // namespace softreel::assets
