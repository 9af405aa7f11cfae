#include <doctest/doctest.h>

#include <map>

#include "pairs.h"
#include "sim/contact/free_path.h"

using namespace softreel;
using namespace softreel::sim;
using Eigen::Vector3d;

namespace {

FourPoints along(const FourPoints& x, const FourPoints& p, double s) {
  FourPoints result;
  for (size_t i = 0; i < 4; ++i) result[i] = x[i] + s * p[i];
  return result;
}

/// The smallest distance on the way up to s, looked for at many places.
double smallest_on_way(PairKind kind, const FourPoints& x, const FourPoints& p, double s) {
  double smallest = 1e300;
  for (int k = 0; k <= 400; ++k) smallest = std::min(smallest, pair_distance(kind, along(x, p, s * k / 400)));
  return smallest;
}

const FourPoints kTriangle = {Vector3d(0.2, 1, 0.2), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)};

FourPoints point_moves(const Vector3d& move) { return {move, Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()}; }

}  // namespace

TEST_CASE("a free path keeps a tenth of the gap everywhere, whatever the pair does") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1), size(-3, 3);
  for (const auto& pair : tests::pairs_of_every_region(40)) {
    FourPoints p;
    const double length = std::pow(10, size(random));
    for (auto& v : p) v = length * Vector3d(coordinate(random), coordinate(random), coordinate(random));
    const double offset = 0.3 * pair_distance(pair.kind, pair.x), gap = 0.7 * pair_distance(pair.kind, pair.x);
    const double s = free_path(pair.kind, pair.x, p, offset);
    CHECK(s > 0);
    CHECK(smallest_on_way(pair.kind, pair.x, p, s) - offset >= kKeptGap * gap * (1 - 1e-9));
  }
}

TEST_CASE("a free path goes nearly as far as it could") {
  // Straight at the triangle from a height of 1: 0.9 of the way are free.
  const double s = free_path(PairKind::kPointTriangle, kTriangle, point_moves({0, -1, 0}), 0);
  CHECK(s <= 0.9);
  CHECK(s > 0.85);
  CHECK(free_path(PairKind::kPointTriangle, kTriangle, point_moves({0, 1, 0}), 0) == 1);
  CHECK(free_path(PairKind::kPointTriangle, kTriangle, point_moves({0, 0, 0}), 0) == 1);
  FourPoints together;
  together.fill(Vector3d(1000, -1000, 500));
  CHECK(free_path(PairKind::kPointTriangle, kTriangle, together, 0) == 1);
}

TEST_CASE("nasty moves are never let through") {
  const Vector3d o = Vector3d::Zero();
  struct Case {
    const char* what;
    PairKind kind;
    FourPoints x, p;
    double offset;
  };
  const double far = 1000.0 / 60;  // 1000 m/s for a sixtieth of a second
  const std::vector<Case> cases = {
      {"1000 m/s", PairKind::kPointTriangle, kTriangle, point_moves({0, -far, 0}), 0},
      {"1000 m/s aslant",
       PairKind::kPointTriangle,
       {Vector3d(-0.8, 1, -0.1), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)},
       point_moves({far, -far, 0.3 * far}),
       0},
      {"a gap of 1e-9",
       PairKind::kPointTriangle,
       {Vector3d(0.2, 1e-9, 0.2), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)},
       point_moves({0, -1, 0}),
       0},
      {"coplanar, into an edge",
       PairKind::kPointTriangle,
       {Vector3d(-1, 0, 0.3), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)},
       point_moves({2, 0, 0}),
       0},
      {"a flat triangle",
       PairKind::kPointTriangle,
       {Vector3d(0.5, 1, 0), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(2, 0, 0)},
       point_moves({0, -2, 0}),
       0},
      {"a triangle that is a point",
       PairKind::kPointTriangle,
       {Vector3d(0, 1, 0), o, o, o},
       point_moves({0, -2, 0}),
       0},
      {"parallel edges",
       PairKind::kEdgeEdge,
       {Vector3d(0, 1, 0), Vector3d(1, 1, 0), Vector3d(0, 0, 0), Vector3d(1, 0, 0)},
       {Vector3d(0, -2, 0), Vector3d(0, -2, 0), o, o},
       0},
      {"edges in one line",
       PairKind::kEdgeEdge,
       {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(2, 0, 0), Vector3d(3, 0, 0)},
       {Vector3d(3, 0, 0), Vector3d(3, 0, 0), o, o},
       0},
      {"an edge without length",
       PairKind::kEdgeEdge,
       {Vector3d(0.5, 1, 0), Vector3d(0.5, 1, 0), o, Vector3d(1, 0, 0)},
       {Vector3d(0, -2, 0), Vector3d(0, -2, 0), o, o},
       0},
      {"crossed edges at 1000 m/s",
       PairKind::kEdgeEdge,
       {Vector3d(0.5, 0.01, -1), Vector3d(0.5, 0.01, 1), o, Vector3d(1, 0, 0)},
       {Vector3d(0, -far, 0), Vector3d(0, -far, 0), o, o},
       0},
      {"an edge that turns over",
       PairKind::kEdgeEdge,
       {Vector3d(0.5, 0.2, -1), Vector3d(0.5, 0.2, 1), o, Vector3d(1, 0, 0)},
       {Vector3d(0, -1, 0), Vector3d(0, 0.4, 0), o, o},
       0},
      {"with a thickness", PairKind::kPointTriangle, kTriangle, point_moves({0, -5, 0}), 0.4},
  };
  for (const Case& c : cases) {
    INFO(c.what);
    const double gap = pair_distance(c.kind, c.x) - c.offset;
    const double s = free_path(c.kind, c.x, c.p, c.offset);
    CHECK(s > 0);
    CHECK(s < 1);
    CHECK(smallest_on_way(c.kind, c.x, c.p, s) - c.offset >= kKeptGap * gap * (1 - 1e-9));
  }
}

TEST_CASE("grazing at any speed is stopped late or not at all, and ends after a bounded number of pieces") {
  // Passes 1e-6 above the triangle, 16 m in one step.
  const FourPoints x = {Vector3d(-8, 1e-6, 0.2), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)};
  const double s = free_path(PairKind::kPointTriangle, x, point_moves({16, 0, 0}), 0);
  CHECK(s > 0.4);
  CHECK(smallest_on_way(PairKind::kPointTriangle, x, point_moves({16, 0, 0}), s) > 0);
}

TEST_CASE("pairs that touch already may not move against each other") {
  const FourPoints touching = {Vector3d(0.2, 0, 0.2), Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)};
  CHECK(free_path(PairKind::kPointTriangle, touching, point_moves({0, -1, 0}), 0) == 0);
  CHECK(free_path(PairKind::kPointTriangle, kTriangle, point_moves({0, -1, 0}), 2) == 0);
}
