#pragma once
// What the tests of meshes and files share.
#include <doctest/doctest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "assets/error.h"
#include "sim/mesh.h"

namespace softreel::test {

/// A folder that goes away with its test.
class TempFolder {
 public:
  TempFolder() {
    static int counter = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("softreel-test-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  int files() const {
    int n = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) n += entry.is_regular_file();
    return n;
  }

 private:
  std::filesystem::path path_;
};

inline std::string slurp(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// The message of the UserError of this kind that `action` throws; fails the test otherwise.
template <class Action>
std::string user_error(assets::ErrorKind kind, Action&& action) {
  try {
    action();
  } catch (const assets::UserError& error) {
    CHECK(error.kind() == kind);
    return error.what();
  } catch (const std::exception& error) {
    FAIL_CHECK("another exception: " << std::string(error.what()));
    return "";
  }
  FAIL_CHECK("no error");
  return "";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Corners at +-half around a centre, faces outwards.
inline sim::TriangleMesh cube(double half = 0.5, const sim::Vec3& center = sim::Vec3::Zero()) {
  sim::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(center + half * sim::Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// An octahedron subdivided `levels` times onto the unit sphere: 8 * 4^levels faces.
inline sim::TriangleMesh sphere(int levels) {
  sim::TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (fresh) {
        mesh.vertices.push_back(
            (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]).normalized());
      }
      return found->second;
    };
    std::vector<sim::Triangle> finer;
    for (const sim::Triangle& t : mesh.triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// Both in one mesh, not connected.
inline sim::TriangleMesh together(sim::TriangleMesh a, const sim::TriangleMesh& b) {
  const int shift = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const sim::Triangle& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

inline sim::TriangleMesh turned_over(sim::TriangleMesh mesh) {
  for (sim::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Five tets of a unit cube, mixed with nothing else.
inline sim::TetMesh five_tets() {
  sim::TetMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
  mesh.vertices[7] += sim::Vec3(1.0 / 3, 1e-17, 0.1);  // digits that do not end
  mesh.tets = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}, {1, 2, 4, 7}};
  for (sim::Tet& t : mesh.tets) {
    const auto p = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    if (sim::tet_volume(p(0), p(1), p(2), p(3)) < 0) std::swap(t[2], t[3]);
  }
  return mesh;
}

inline double volume(const sim::TetMesh& mesh) {
  double v = 0;
  for (const sim::Tet& t : mesh.tets) {
    v += sim::tet_volume(mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
                         mesh.vertices[static_cast<std::size_t>(t[2])], mesh.vertices[static_cast<std::size_t>(t[3])]);
  }
  return v;
}

}  // namespace softreel::test
