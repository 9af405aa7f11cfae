#include <random>

#include "assets/crossing_pairs.h"
#include "assets/exact_predicates.h"
#include "assets/surface_diagnosis.h"
#include "assets/surface_import.h"
#include "tests/assets/support.h"

using namespace softreel;
using assets::describe;
using assets::diagnose_surface;
using test::contains;

TEST_CASE("A cube and a sphere bound solids of their volume") {
  const auto d = diagnose_surface(test::cube());
  CHECK(d.bounds_solid());
  CHECK(describe(d) == "");
  CHECK(d.volume == doctest::Approx(1).epsilon(1e-14));
  CHECK(d.area == doctest::Approx(6).epsilon(1e-14));
  CHECK(d.components == 1);
  CHECK(diagnose_surface(test::sphere(3)).bounds_solid());
}

TEST_CASE("Missing faces are open edges around holes, with a place") {
  auto mesh = test::cube();
  mesh.triangles.erase(mesh.triangles.begin() + 6);  // at y = 1/2
  mesh.triangles.erase(mesh.triangles.begin());      // at z = -1/2
  const auto d = diagnose_surface(mesh);
  CHECK(d.open_edges.count == 6);
  CHECK(d.boundary_loops == 1);  // the two triangles share a corner
  CHECK_FALSE(d.bounds_solid());
  CHECK(contains(describe(d), "6 open edges around 1 hole near ("));
  mesh = test::sphere(2);
  mesh.triangles.erase(mesh.triangles.begin() + 100);
  mesh.triangles.erase(mesh.triangles.begin());
  CHECK(diagnose_surface(mesh).boundary_loops == 2);
}

TEST_CASE("A fin makes an edge with three faces") {
  auto mesh = test::cube();
  mesh.vertices.emplace_back(2, 2, 2);
  mesh.triangles.push_back({6, 7, 8});
  const auto d = diagnose_surface(mesh);
  CHECK(d.non_manifold_edges.count == 1);
  CHECK(d.non_manifold_edges.where.front().isApprox(sim::Vec3(0, 0.5, 0.5)));
  CHECK(contains(describe(d), "non-manifold: 1 edge"));
}

TEST_CASE("Two cubes that share one corner touch in a non-manifold vertex") {
  auto mesh = test::together(test::cube(), test::cube(0.5, {1, 1, 1}));
  for (sim::Triangle& t : mesh.triangles) {
    for (int& v : t) v = v == 8 ? 7 : v > 8 ? v - 1 : v;
  }
  mesh.vertices.erase(mesh.vertices.begin() + 8);
  const auto d = diagnose_surface(mesh);
  CHECK(d.non_manifold_vertices.count == 1);
  CHECK(d.non_manifold_vertices.where.front().isApprox(sim::Vec3(0.5, 0.5, 0.5)));
  CHECK(d.crossings.count == 0);
}

TEST_CASE("A turned face is seen by its three edges, a turned surface is inside out") {
  auto mesh = test::cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  CHECK(diagnose_surface(mesh).flipped_edges.count == 3);
  const auto d = diagnose_surface(test::turned_over(test::cube()));
  CHECK(d.inside_out.count == 1);
  CHECK(d.volume == doctest::Approx(-1));
  CHECK(contains(describe(d), "inside out"));
}

TEST_CASE("A cavity is fine, a solid inside a solid is not, side by side is fine") {
  const auto small = test::cube(0.2);
  const auto cavity = diagnose_surface(test::together(test::cube(), test::turned_over(small)));
  CHECK(cavity.bounds_solid());
  CHECK(cavity.volume == doctest::Approx(1 - 0.064));
  CHECK(cavity.components == 2);
  CHECK(diagnose_surface(test::together(test::cube(), small)).nested.count == 1);
  CHECK(diagnose_surface(test::together(test::cube(), test::cube(0.3, {3, 0, 0}))).bounds_solid());
  CHECK(
      diagnose_surface(test::together(test::cube(), test::turned_over(test::cube(0.3, {3, 0, 0})))).inside_out.count ==
      1);
}

TEST_CASE("Crossing surfaces are found, and touching ones") {
  CHECK(diagnose_surface(test::together(test::cube(), test::cube(0.5, {0.7, 0.2, 0.1}))).crossings.count > 0);
  // Face to face at x = 1/2, with no vertex in common.
  CHECK(diagnose_surface(test::together(test::cube(), test::cube(0.25, {0.75, 0, 0}))).crossings.count > 0);
  // The smallest gap there is: no crossing.
  const double apart = std::nextafter(0.75, 1.0);
  CHECK(diagnose_surface(test::together(test::cube(), test::cube(0.25, {apart, 0, 0}))).crossings.count == 0);
  const auto d = diagnose_surface(test::together(test::cube(), test::cube(0.5, {0.7, 0.2, 0.1})), 3);
  CHECK(d.crossings.count == 3);
}

TEST_CASE("Flat, doubled and unused parts are counted") {
  auto mesh = test::cube();
  mesh.triangles.push_back(mesh.triangles[2]);
  mesh.vertices.emplace_back(0, 0, 0.5);
  mesh.vertices.emplace_back(0, 0, 9);
  mesh.triangles.push_back({4, 7, 8});  // on the diagonal of the top
  const auto d = diagnose_surface(mesh);
  CHECK(d.duplicates.count == 1);
  CHECK(d.zero_area.count == 1);
  CHECK(d.unused_vertices.count == 1);
  CHECK(describe(diagnose_surface({})) == "the surface has no faces");
}

TEST_CASE("Orientation is exact where doubles alone are wrong") {
  // d lies in the plane x + y + z = 3 up to the last bits of one coordinate.
  const sim::Vec3 a(3, 0, 0), b(0, 3, 0), c(0, 0, 3);
  const double third = 1.1;
  const double x = 3 - third - third;  // exact: Sterbenz does not hold, so test what the sum really is
  for (const double nudge : {-1.0, 0.0, 1.0}) {
    const sim::Vec3 d(x + nudge * std::ldexp(1.0, -53), third, third);
    const long double side = static_cast<long double>(d.x()) + d.y() + d.z() - 3.0L;  // 64 bits hold this sum
    const int expected = side > 0 ? 1 : side < 0 ? -1 : 0;
    CHECK(assets::orient3d_sign(a, b, c, d) == expected);
    CHECK(assets::orient3d_sign(b, a, c, d) == -expected);
  }
  // In the plane: a whole multiple up to 3 of a short number.

  const sim::Vec3 u(0.25, 0.625, 0);
  CHECK(assets::orient2d_sign(sim::Vec3::Zero(), u, 3 * u, 2) == 0);
  CHECK(assets::orient2d_sign(sim::Vec3::Zero(), u, 3 * u + sim::Vec3(0, 1e-300, 0), 2) == 0);  // lost in the sum
  CHECK(assets::orient2d_sign(sim::Vec3::Zero(), {1, 1, 0}, {0.5, std::nextafter(0.5, 1.0), 0}, 2) == 1);
}

TEST_CASE("Triangles that share an edge cross only when folded flat") {
  const std::vector<sim::Vec3> v = {{0, 0, 0},    {1, 0, 0},          {0, 1, 0}, {0.3, 0.9, 0},
                                    {0.5, -1, 0}, {0.3, 0.3, 1e-300}, {2, 1, 0}};
  CHECK(assets::triangles_cross(v, {0, 1, 2}, {1, 0, 3}));
  CHECK_FALSE(assets::triangles_cross(v, {0, 1, 2}, {1, 0, 4}));
  CHECK_FALSE(assets::triangles_cross(v, {0, 1, 2}, {1, 6, 4}));  // a vertex only
  CHECK(assets::triangles_cross(v, {0, 1, 2}, {0, 3, 6}));        // a vertex, and more
}

namespace {

/// Are the hulls of two sets of points on a lattice apart? By all axes that can tell (normals, products of edges, edges
/// turned in their plane), in whole numbers below 2^53: exact.
bool hulls_apart(const std::vector<sim::Vec3>& a, const std::vector<sim::Vec3>& b) {
  const auto edges = [](const std::vector<sim::Vec3>& p) {
    std::vector<sim::Vec3> e;
    for (size_t i = 0; i < p.size(); ++i)
      for (size_t j = 0; j < i; ++j) e.push_back(p[i] - p[j]);
    return e;
  };
  const std::vector<sim::Vec3> ea = edges(a), eb = edges(b);
  std::vector<sim::Vec3> axes;
  for (const auto* p : {&ea, &eb})
    for (const auto* q : {&ea, &eb})
      for (const sim::Vec3& u : *p)
        for (const sim::Vec3& v : *q) {
          axes.push_back(u.cross(v));
          for (const sim::Vec3& w : *p) axes.push_back(w.cross(u.cross(v)));
        }
  for (const sim::Vec3& axis : axes) {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const auto& [k, points] : {std::pair{0, &a}, std::pair{1, &b}})
      for (const sim::Vec3& x : *points) {
        low[k] = std::min(low[k], axis.dot(x));
        high[k] = std::max(high[k], axis.dot(x));
      }
    if (high[0] < low[1] || high[1] < low[0]) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("On a lattice, where most triangles touch or lie in one plane, crossings are those of exact arithmetic") {
  std::mt19937 random(5);
  const auto point = [&](int side) {
    const auto number = [&] { return static_cast<double>(random() % static_cast<unsigned>(side)); };
    return sim::Vec3(number(), number(), number());
  };
  int crossing[3] = {}, apart[3] = {};
  for (int trial = 0; trial < 6000; ++trial) {
    std::vector<sim::Vec3> v;
    for (int i = 0; i < 6; ++i) v.push_back(point(2 + trial % 4));
    if (trial % 2)
      for (sim::Vec3& x : v) x.y() = 1;
    const int shared = trial / 8 % 3;
    const sim::Triangle s{0, 1, 2}, t{shared > 0 ? 0 : 3, shared > 1 ? 1 : 4, 5};
    const auto at = [&](int i) { return v[static_cast<size_t>(i)]; };
    if (assets::is_flat(at(s[0]), at(s[1]), at(s[2])) || assets::is_flat(at(t[0]), at(t[1]), at(t[2]))) continue;
    bool expected = false;
    if (shared == 0)
      expected = !hulls_apart({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    else if (shared == 1)
      expected = !hulls_apart({v[1], v[2]}, {v[0], v[4], v[5]}) || !hulls_apart({v[4], v[5]}, {v[0], v[1], v[2]});
    else {
      const sim::Vec3 n = (v[1] - v[0]).cross(v[2] - v[0]), m = (v[1] - v[0]).cross(v[5] - v[0]);
      expected = n.cross(m).isZero(0) && n.dot(m) > 0;
    }
    CHECK(assets::triangles_cross(v, s, t) == expected);
    CHECK(assets::triangles_cross(v, t, s) == expected);
    // The filters decide in rounded arithmetic: the same far from the origin and very small (both exact here).
    for (sim::Vec3& x : v) x = std::ldexp(1.0, -60) * (x + sim::Vec3(1048576, -4194304, 3));
    CHECK(assets::triangles_cross(v, s, t) == expected);
    ++(expected ? crossing : apart)[shared];
  }
  for (int shared = 0; shared < 3; ++shared) {
    CHECK(crossing[shared] > 50);
    CHECK(apart[shared] > 50);
  }
}

TEST_CASE("Only pairs that are wanted are looked at") {
  sim::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.3, 0.2, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  CHECK(assets::crossing_pairs(mesh, 10).size() == 1);
  CHECK(assets::crossing_pairs(mesh, 10, [](int, int) { return false; }).empty());
}

TEST_CASE("Of the real meshes only the cow crosses itself") {
  const std::filesystem::path folder = SOFTREEL_SHARED_MESHES;
  if (!std::filesystem::exists(folder / "cow.off")) {
    MESSAGE("no real meshes here: left out");
    return;
  }
  for (const char* name : {"spot.obj", "bunny.off", "3holes.off", "cow.off"}) {
    const auto d = diagnose_surface(assets::import_surface(folder / name).welded);
    CHECK_MESSAGE(d.bounds_solid() == (std::string(name) != "cow.off"), name);
    if (std::string(name) == "cow.off") CHECK(contains(describe(d), "crosses itself in"));
  }
}
