#include "assets/tet_quality.h"
#include "tests/assets/support.h"

using namespace softreel;

TEST_CASE("A regular tetrahedron has radius ratio 1 and dihedral angles of acos 1/3") {
  const sim::TetMesh mesh = {{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}, {{0, 1, 3, 2}}};
  const auto q = assets::tet_quality(mesh);
  CHECK(std::abs(q.volume) == doctest::Approx(8.0 / 3));
  CHECK(q.worst_radius_ratio == doctest::Approx(1).epsilon(1e-12));
  for (const double angle : {q.min_dihedral, q.median_dihedral, q.max_dihedral}) {
    CHECK(angle == doctest::Approx(std::acos(1.0 / 3) * 180 / M_PI).epsilon(1e-12));
  }
}

TEST_CASE("A corner of a cube has the radius ratio and angles of the textbook") {
  const sim::TetMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  const auto q = assets::tet_quality(mesh);
  // r_in = 1 / (3 + sqrt 3), r_circ = sqrt 3 / 2.
  CHECK(q.worst_radius_ratio == doctest::Approx(3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2)).epsilon(1e-12));
  CHECK(q.max_dihedral == doctest::Approx(90).epsilon(1e-12));
  CHECK(q.min_dihedral == doctest::Approx(std::atan(std::sqrt(2.0)) * 180 / M_PI).epsilon(1e-12));
  CHECK(q.tets == 1);
}

TEST_CASE("A flat tetrahedron has radius ratio near 0") {
  const sim::TetMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-9}, {0, 1, 0}}, {{0, 1, 3, 2}, {0, 1, 2, 3}}};
  CHECK(assets::tet_quality(mesh).worst_radius_ratio < 1e-8);
}
