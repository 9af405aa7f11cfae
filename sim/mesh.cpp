#include "sim/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace softreel::sim {

double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

std::vector<Triangle> boundary_triangles(const TetMesh& mesh) {
  struct Face {
    Triangle key;  // sorted, to meet its twin
    Triangle oriented;
    size_t order;
  };
  std::vector<Face> faces;
  faces.reserve(mesh.tets.size() * 4);
  for (const Tet& t : mesh.tets) {
    for (const Triangle& f : {Triangle{t[0], t[2], t[1]}, Triangle{t[0], t[1], t[3]}, Triangle{t[1], t[2], t[3]},
                              Triangle{t[0], t[3], t[2]}}) {
      Triangle key = f;
      std::sort(key.begin(), key.end());
      faces.push_back({key, f, faces.size()});
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.key != b.key ? a.key < b.key : a.order < b.order; });
  std::vector<Face> outer;
  for (size_t i = 0; i < faces.size();) {
    size_t j = i + 1;
    while (j < faces.size() && faces[j].key == faces[i].key) ++j;
    if (j == i + 1) outer.push_back(faces[i]);
    i = j;
  }
  std::sort(outer.begin(), outer.end(), [](const Face& a, const Face& b) { return a.order < b.order; });
  std::vector<Triangle> triangles;
  triangles.reserve(outer.size());
  for (const Face& f : outer) triangles.push_back(f.oriented);
  return triangles;
}

}  // namespace softreel::sim
