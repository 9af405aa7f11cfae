#include "assets/generate/disc.h"

#include <cmath>
#include <numbers>

namespace softreel::generate {

sim::TriangleMesh disc(double radius, int rings) {
  sim::TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, 0);
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring)
    for (int k = 0; k < 6 * ring; ++k) {
      const double angle = 2 * std::numbers::pi * k / (6 * ring);
      mesh.vertices.emplace_back(radius * ring / rings * sim::Vec3(std::cos(angle), 0, -std::sin(angle)));
    }
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int k = 0; k < ring; ++k) {
        const int count = 6 * ring, inner = 6 * (ring - 1);
        const auto outside = [&](int i) { return first(ring) + (sector * ring + i) % count; };
        const auto inside = [&](int i) { return ring == 1 ? 0 : first(ring - 1) + (sector * (ring - 1) + i) % inner; };
        mesh.triangles.push_back({outside(k), outside(k + 1), inside(k)});
        if (k + 1 < ring) mesh.triangles.push_back({outside(k + 1), inside(k + 1), inside(k)});
      }
  return mesh;
}

}  // namespace softreel::generate
