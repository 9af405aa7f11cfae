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
