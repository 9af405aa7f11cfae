// From the corners of a file to welded vertices for the physics and split ones for the picture.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "assets/drop_unused.h"
#include "assets/error.h"
#include "assets/raw_surface.h"

namespace softreel::assets {
namespace {

// assimp reads single precision, whose last bit is 6e-8 of the value: a little more than that.
constexpr double kWeldTolerance = 1e-7;  // of the longest side of the bounding box

std::uint64_t mix(std::uint64_t h, std::uint64_t v) {
  h ^= v + 0x9e3779b97f4a7c15ull + (h << 6) + (h >> 2);
  return h * 0xff51afd7ed558ccdull;
}

struct Cell {
  std::int64_t x, y, z;
  bool operator==(const Cell&) const = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    return static_cast<std::size_t>(
        mix(mix(static_cast<std::uint64_t>(c.x), static_cast<std::uint64_t>(c.y)), static_cast<std::uint64_t>(c.z)));
  }
};

bool has_area(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) {
  return (b - a).cross(c - a).squaredNorm() > 0;
}

void check_finite(const RawSurface& raw, const std::string& name) {
  for (std::size_t i = 0; i < raw.positions.size(); ++i) {
    if (raw.positions[i].allFinite()) continue;
    throw UserError(ErrorKind::kInput, name,
                    fmt::format("vertex {} has a coordinate that is no finite number; export the mesh again", i + 1));
  }
}

}  // namespace

Welding weld(const std::vector<sim::Vec3>& positions, double tolerance) {
  Welding result;
  result.of.reserve(positions.size());
  // Cells wider than the tolerance, so that a match lies in one of 27; at least one bit of the largest coordinate.
  double largest = 0;
  for (const sim::Vec3& p : positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  const double cell = std::max({2 * tolerance, largest * 1e-15, std::numeric_limits<double>::min()});
  // The vertices of a cell are a chain: the last one found, and for each vertex the one before it.
  std::unordered_map<Cell, int, CellHash> last_in;
  last_in.reserve(positions.size());
  std::vector<int> before;
  before.reserve(positions.size());
  const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell)); };
  for (const sim::Vec3& p : positions) {
    int match = -1;
    const Cell lo = {index(p.x() - tolerance), index(p.y() - tolerance), index(p.z() - tolerance)};
    const Cell hi = {index(p.x() + tolerance), index(p.y() + tolerance), index(p.z() + tolerance)};
    for (auto x = lo.x; x <= hi.x; ++x) {
      for (auto y = lo.y; y <= hi.y; ++y) {
        for (auto z = lo.z; z <= hi.z; ++z) {
          const auto found = last_in.find({x, y, z});
          if (found == last_in.end()) continue;
          for (int v = found->second; v >= 0; v = before[static_cast<std::size_t>(v)]) {
            if ((result.vertices[static_cast<std::size_t>(v)] - p).norm() > tolerance) continue;
            if (match < 0 || v < match) match = v;
          }
        }
      }
    }
    if (match < 0) {
      match = static_cast<int>(result.vertices.size());
      result.vertices.push_back(p);
      const auto [at, fresh] = last_in.try_emplace({index(p.x()), index(p.y()), index(p.z())}, match);
      before.push_back(fresh ? -1 : std::exchange(at->second, match));
    }
    result.of.push_back(match);
  }
  return result;
}

ImportedSurface build_surface(RawSurface raw, const std::string& name, const MeshOptions& options) {
  check_finite(raw, name);
  Eigen::AlignedBox3d box;
  for (const sim::Vec3& p : raw.positions) box.extend(p);
  const double longest = raw.positions.empty() ? 0.0 : box.sizes().maxCoeff();
  if (!std::isfinite(longest)) throw UserError(ErrorKind::kInput, name, "its coordinates are too large for numbers");
  Welding welding = weld(raw.positions, kWeldTolerance * longest);

  ImportedSurface out;
  out.missing_textures = std::move(raw.missing_textures);
  out.dropped_other = static_cast<int>(std::min<std::int64_t>(raw.dropped_other, std::numeric_limits<int>::max()));
  out.welded.vertices = std::move(welding.vertices);
  // Corners of one position are one vertex of the picture where texture coordinates and normal are the same bit by bit.
  std::vector<int> last_at(out.welded.vertices.size(), -1);  // render vertex, and for each the one before it
  std::vector<int> before;
  std::vector<int> raw_of;
  const auto same_corner = [&](std::size_t a, std::size_t b) {
    return (raw.uv.empty() || std::memcmp(raw.uv[a].data(), raw.uv[b].data(), 8) == 0) &&
           (raw.normals.empty() || std::memcmp(raw.normals[a].data(), raw.normals[b].data(), 12) == 0);
  };
  const auto render_vertex = [&](int raw_vertex) {
    const auto r = static_cast<std::size_t>(raw_vertex);
    int& last = last_at[static_cast<std::size_t>(welding.of[r])];
    for (int v = last; v >= 0; v = before[static_cast<std::size_t>(v)])
      if (same_corner(static_cast<std::size_t>(raw_of[static_cast<std::size_t>(v)]), r)) return v;
    before.push_back(last);
    raw_of.push_back(raw_vertex);
    last = static_cast<int>(out.position_of.size());
    out.position_of.push_back(welding.of[r]);
    if (!raw.uv.empty()) out.uv.push_back(raw.uv[r]);
    if (!raw.normals.empty()) out.normals.push_back(raw.normals[r]);
    return last;
  };
  for (SurfacePart& part : raw.parts) {
    const int first = static_cast<int>(out.triangles.size());
    for (int i = part.first_triangle; i < part.first_triangle + part.triangle_count; ++i) {
      const sim::Triangle& t = raw.triangles[static_cast<std::size_t>(i)];
      sim::Triangle w;
      for (int k = 0; k < 3; ++k) w[k] = welding.of[static_cast<std::size_t>(t[k])];
      const auto p = [&](int k) -> const sim::Vec3& { return out.welded.vertices[static_cast<std::size_t>(w[k])]; };
      if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0] || !has_area(p(0), p(1), p(2))) {
        ++out.dropped_degenerate;
        continue;
      }
      out.welded.triangles.push_back(w);
      out.triangles.push_back({render_vertex(t[0]), render_vertex(t[1]), render_vertex(t[2])});
    }
    part.first_triangle = first;
    part.triangle_count = static_cast<int>(out.triangles.size()) - first;
    if (part.triangle_count > 0) out.parts.push_back(std::move(part));
  }
  if (out.triangles.empty()) {
    throw UserError(ErrorKind::kInput, name,
                    fmt::format("holds no triangles ({} without area, {} points and lines); a surface needs faces",
                                out.dropped_degenerate, out.dropped_other));
  }
  const std::vector<int> number = drop_unused(out.welded.vertices, out.welded.triangles);
  for (int& v : out.position_of) v = number[static_cast<std::size_t>(v)];
  apply_mesh_options(options, out.welded.vertices);
  if (options.up != 'y') {
    const Eigen::Matrix3f turn = y_from_up(options.up).cast<float>();
    for (Eigen::Vector3f& n : out.normals) n = turn * n;
  }
  return out;
}

ImportedSurface surface_from_mesh(sim::TriangleMesh mesh) {
  ImportedSurface out;
  out.welded = std::move(mesh);
  out.triangles = out.welded.triangles;
  out.position_of.resize(out.welded.vertices.size());
  for (std::size_t i = 0; i < out.position_of.size(); ++i) out.position_of[i] = static_cast<int>(i);
  SurfacePart part;
  part.triangle_count = static_cast<int>(out.triangles.size());
  out.parts.push_back(std::move(part));
  return out;
}

}  // namespace softreel::assets
