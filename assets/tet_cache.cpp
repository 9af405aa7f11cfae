// Tetrahedra are made once for the same surface and options.
#include "assets/atomic_file.h"
#include "assets/blob.h"
#include "assets/content_hash.h"
#include "assets/error.h"
#include "assets/tetrahedralize.h"

namespace softreel::assets {
namespace {

constexpr std::string_view kMagic = "softreel tets 1\n";  // the number: of the format and of the switches behind it

std::string cache_key(const sim::TriangleMesh& surface, const TetrahedralizeOptions& options) {
  ContentHasher hash;
  hash.add(kMagic).add_span(std::span(surface.vertices)).add_span(std::span(surface.triangles));
  return hash.add(options.quality).add(options.max_volume).hex();
}

bool valid(const sim::TetMesh& mesh, std::size_t surface_vertices) {
  const int n = static_cast<int>(mesh.vertices.size());
  for (const sim::Tet& t : mesh.tets) {
    for (const int v : t) {
      if (v < 0 || v >= n) return false;
    }
  }
  return !mesh.tets.empty() && mesh.vertices.size() >= surface_vertices;
}

/// False for whatever is not exactly what was once written for this key.
bool read_cached(const std::filesystem::path& file, const std::string& key, std::size_t surface_vertices,
                 sim::TetMesh& mesh) {
  try {
    const std::string bytes = read_file(file);
    BlobReader in(bytes);
    for (const char c : kMagic) {
      if (in.value<char>() != c) return false;
    }
    const auto checksum = in.value<std::uint64_t>();
    const std::size_t header = kMagic.size() + sizeof checksum;
    if (checksum64(std::string_view(bytes).substr(header)) != checksum || in.text() != key) return false;
    mesh.vertices = in.array<sim::Vec3>();
    mesh.tets = in.array<sim::Tet>();
    return in.at_end() && valid(mesh, surface_vertices);
  } catch (const UserError&) {  // missing, unreadable
    return false;
  } catch (const BrokenBlob&) {
    return false;
  }
}

void write_cached(const std::filesystem::path& file, const std::string& key, const sim::TetMesh& mesh) {
  BlobWriter payload;
  payload.text(key);
  payload.array(mesh.vertices);
  payload.array(mesh.tets);
  AtomicFile out(file);
  out.write(kMagic);
  const std::uint64_t checksum = checksum64(payload.bytes);
  out.write(&checksum, sizeof checksum);
  out.write(payload.bytes);
  out.commit();
}

}  // namespace

CachedTets tetrahedralize_cached(const sim::TriangleMesh& surface, const std::string& name,
                                 const TetrahedralizeOptions& options, const std::filesystem::path& cache_folder) {
  CachedTets result;
  if (cache_folder.empty()) {
    result.mesh = tetrahedralize(surface, name, options);
    return result;
  }
  const std::string key = cache_key(surface, options);
  const std::filesystem::path file = cache_folder / (key + ".tets");
  if (read_cached(file, key, surface.vertices.size(), result.mesh)) {
    result.from_cache = true;
    return result;
  }
  result.mesh = tetrahedralize(surface, name, options);
  make_folders(cache_folder);
  write_cached(file, key, result.mesh);
  return result;
}

}  // namespace softreel::assets
