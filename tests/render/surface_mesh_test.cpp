#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <stdexcept>

#include "render/smooth_normals.h"
#include "render/surface_mesh.h"

using namespace softreel::render;

namespace {

std::vector<glm::vec3> vertex_normals(const SurfaceMesh& mesh, const std::vector<glm::vec3>& positions) {
  std::vector<glm::vec3> groups(normal_group_count(mesh));
  compute_smooth_normals(mesh, positions, groups);
  std::vector<glm::vec3> result;
  for (std::size_t i = 0; i < mesh.position_of.size(); ++i)
    result.push_back(groups[mesh.normal_of.empty() ? mesh.position_of[i] : mesh.normal_of[i]]);
  return result;
}

/// A cube of 8 welded positions and 12 triangles, one render vertex per position.
Shape welded_cube() {
  Shape box = make_box({1, 1, 1});
  std::vector<glm::uvec3> triangles;
  for (const glm::uvec3& t : box.mesh.triangles)
    triangles.emplace_back(box.mesh.position_of[t.x], box.mesh.position_of[t.y], box.mesh.position_of[t.z]);
  return {mesh_from_triangles(8, triangles), box.positions};
}

}  // namespace

TEST_CASE("vertex normals of a sphere of triangles point away from its centre") {
  const Shape sphere = make_sphere(2.0f, 32);
  const std::vector<glm::vec3> normals = vertex_normals(sphere.mesh, sphere.positions);
  // Max's weights are exact for vertices on a sphere, whatever the triangles: only rounding is left.
  for (std::size_t i = 0; i < normals.size(); ++i)
    CHECK(glm::dot(normals[i], sphere.positions[sphere.mesh.position_of[i]]) / 2.0f > 1 - 2e-5f);
}

TEST_CASE("a texture seam is no seam for the normals") {
  Shape sphere = make_sphere(1.0f, 24);
  REQUIRE(sphere.mesh.position_of.size() > sphere.mesh.position_count);
  sphere.mesh.normal_of.clear();
  const std::size_t before = sphere.mesh.position_of.size();
  group_by_crease(sphere.mesh, sphere.positions, 60);
  CHECK(sphere.mesh.position_of.size() == before);
  CHECK(normal_group_count(sphere.mesh) == sphere.mesh.position_count);
}

TEST_CASE("edges sharper than the crease angle stay hard, others become smooth") {
  Shape cube = welded_cube();
  SUBCASE("90 degrees are sharper than 60") {
    group_by_crease(cube.mesh, cube.positions, 60);
    CHECK(cube.mesh.position_of.size() == 24);
    for (const glm::vec3& n : vertex_normals(cube.mesh, cube.positions))
      CHECK(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) == doctest::Approx(1));
  }
  SUBCASE("but not than 100") {
    group_by_crease(cube.mesh, cube.positions, 100);
    CHECK(cube.mesh.position_of.size() == 8);
    CHECK(normal_group_count(cube.mesh) == 8);
  }
  CHECK_NOTHROW(check_mesh(cube.mesh, 1));
  for (std::size_t i = 0; i < cube.mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      CHECK(cube.mesh.position_of[cube.mesh.triangles[i][k]] == welded_cube().mesh.triangles[i][k]);
}

TEST_CASE("splitting at a crease keeps texture coordinates") {
  Shape cube = welded_cube();
  for (std::size_t i = 0; i < 8; ++i) cube.mesh.uv.emplace_back(static_cast<float>(i), 0.0f);
  group_by_crease(cube.mesh, cube.positions, 30);
  REQUIRE(cube.mesh.uv.size() == 24);
  for (std::size_t i = 0; i < 24; ++i) CHECK(cube.mesh.uv[i].x == static_cast<float>(cube.mesh.position_of[i]));
}

TEST_CASE("normals of a file decide which vertices are smooth together") {
  Shape box = make_box({1, 1, 1});
  const std::vector<glm::vec3> flat = vertex_normals(box.mesh, box.positions);
  box.mesh.normal_of.clear();
  SUBCASE("a normal per face") {
    group_by_normals(box.mesh, flat);
    CHECK(normal_group_count(box.mesh) == 24);
  }
  SUBCASE("one direction per corner") {
    std::vector<glm::vec3> round;
    for (const std::uint32_t p : box.mesh.position_of) round.push_back(3.0f * box.positions[p]);
    group_by_normals(box.mesh, round);
    CHECK(normal_group_count(box.mesh) == 8);
  }
}

TEST_CASE("triangles without area do not spoil the normals of their neighbours") {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0.5f, 0, 0}, {5, 5, 5}};
  const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 1, 3}, {4, 4, 4}};
  SurfaceMesh mesh = mesh_from_triangles(positions.size(), triangles);
  const std::vector<glm::vec3> normals = vertex_normals(mesh, positions);
  for (const glm::vec3& n : normals) CHECK(n == glm::vec3(0, 1, 0));
  group_by_crease(mesh, positions, 30);
  CHECK_NOTHROW(check_mesh(mesh, 1));
}

TEST_CASE("a mesh that does not fit together is refused with the reason") {
  SurfaceMesh mesh = mesh_from_triangles(3, std::vector<glm::uvec3>{{0, 1, 2}});
  CHECK_NOTHROW(check_mesh(mesh, 1));
  CHECK_THROWS_AS(check_mesh(mesh, 0), std::invalid_argument);
  SUBCASE("vertex") { mesh.triangles[0].y = 3; }
  SUBCASE("position") { mesh.position_of[0] = 7; }
  SUBCASE("texture coordinates") { mesh.uv.resize(2); }
  SUBCASE("normal groups too few") { mesh.normal_of.resize(2); }
  SUBCASE("normal groups with a gap") { mesh.normal_of = {0, 2, 2}; }
  SUBCASE("part beyond the end") { mesh.parts = {{0, 2, 0}}; }
  SUBCASE("part that wraps around") { mesh.parts = {{1, ~std::size_t{0}, 0}}; }
  SUBCASE("look") { mesh.parts = {{0, 1, 1}}; }
  CHECK_THROWS_AS(check_mesh(mesh, 1), std::invalid_argument);
}

TEST_CASE("shapes are closed, face outwards and have the size that was asked for") {
  struct Case {
    Shape shape;
    double volume;
    double tolerance;
  };
  constexpr double kPi = 3.14159265358979;
  // Inscribed polyhedra with n segments lose about (1 + 1/2) pi^2 / 3 / (n/2)^2 of the volume: below 1 % for n = 64
  // and 48.
  const std::vector<Case> cases{{make_sphere(0.5f), 4.0 / 3 * kPi / 8, 0.01},
                                {make_box({1, 2, 3}), 6, 1e-6},
                                {make_capsule(0.5f, 2), 4.0 / 3 * kPi / 8 + 2 * kPi / 4, 0.01}};
  for (const Case& c : cases) {
    double volume = 0;
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const glm::uvec3& t : c.shape.mesh.triangles) {
      std::array<std::uint32_t, 3> p{};
      for (int k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = c.shape.mesh.position_of[t[k]];
      volume += glm::dot(c.shape.positions[p[0]], glm::cross(c.shape.positions[p[1]], c.shape.positions[p[2]])) / 6;
      for (std::size_t k = 0; k < 3; ++k) edges.emplace(p[k], p[(k + 1) % 3]);
    }
    CHECK(volume == doctest::Approx(c.volume).epsilon(c.tolerance));
    for (const auto& [a, b] : edges) {
      REQUIRE(edges.count({a, b}) == 1);
      REQUIRE(edges.count({b, a}) == 1);
    }
    CHECK_NOTHROW(check_mesh(c.shape.mesh, 1));
  }
}
