#include "sim/grids.h"

#include <utility>

namespace softreel::sim {

TriangleMesh grid_sheet(double size_x, double size_z, int cells_x, int cells_z) {
  TriangleMesh mesh;
  for (int j = 0; j <= cells_z; ++j)
    for (int i = 0; i <= cells_x; ++i)
      mesh.vertices.emplace_back((static_cast<double>(i) / cells_x - 0.5) * size_x, 0,
                                 (static_cast<double>(j) / cells_z - 0.5) * size_z);
  const auto at = [&](int i, int j) { return j * (cells_x + 1) + i; };
  for (int j = 0; j < cells_z; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, d, c});
        mesh.triangles.push_back({a, c, b});
      } else {
        mesh.triangles.push_back({a, d, b});
        mesh.triangles.push_back({b, d, c});
      }
    }
  }
  return mesh;
}

TetMesh block_of_tets(const Vec3& size, int cells_x, int cells_y, int cells_z) {
  TetMesh mesh;
  for (int k = 0; k <= cells_z; ++k)
    for (int j = 0; j <= cells_y; ++j)
      for (int i = 0; i <= cells_x; ++i)
        mesh.vertices.emplace_back((static_cast<double>(i) / cells_x - 0.5) * size.x(),
                                   (static_cast<double>(j) / cells_y - 0.5) * size.y(),
                                   (static_cast<double>(k) / cells_z - 0.5) * size.z());
  const auto at = [&](int i, int j, int k) { return (k * (cells_y + 1) + j) * (cells_x + 1) + i; };
  // From corner 0 to corner 7 along the three axes, in each of their six orders.
  constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int k = 0; k < cells_z; ++k) {
    for (int j = 0; j < cells_y; ++j) {
      for (int i = 0; i < cells_x; ++i) {
        for (const auto& order : kOrders) {
          int step[3] = {0, 0, 0};
          Tet tet{at(i, j, k), 0, 0, 0};
          for (size_t n = 0; n < 3; ++n) {
            step[order[n]] = 1;
            tet[n + 1] = at(i + step[0], j + step[1], k + step[2]);
          }
          const auto vertex = [&](size_t a) { return mesh.vertices[static_cast<size_t>(tet[a])]; };
          if (tet_volume(vertex(0), vertex(1), vertex(2), vertex(3)) < 0) std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
        }
      }
    }
  }
  return mesh;
}

}  // namespace softreel::sim
