// The broad phase against all pairs that there are.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include "sim/contact/contact_candidates.h"
#include "sim/grids.h"

using namespace softreel::sim;

namespace {

constexpr double kReach = 4e-3;

/// Two sheets of 8 x 8 squares of 5 cm that touch themselves and each other.
ContactSurfaces two_sheets() {
  const TriangleMesh sheet = grid_sheet(0.4, 0.4, 8, 8);
  TriangleMesh other = sheet;
  for (Vec3& v : other.vertices) v.y() += 0.5;
  const int count = static_cast<int>(sheet.vertices.size());
  return ContactSurfaces({{"a", 0, sheet.vertices, sheet.triangles, {}, 0, 0, true, true},
                          {"b", count, other.vertices, other.triangles, {}, 0, 0, true, true}},
                         {});
}

/// Rolled up, layers a few millimetres apart, the second sheet between those of the first.
std::vector<Vec3> rolled(const ContactSurfaces& surfaces, double apart) {
  std::vector<Vec3> x;
  for (int i = 0; i < surfaces.vertices(); ++i) {
    const auto v = static_cast<size_t>(i);
    const double along = surfaces.rest[v].x() + 0.2, layer = surfaces.surface_of[v] == 0 ? 0 : 0.5 * apart;
    const double angle = 40 * along, radius = 0.02 + layer + apart * angle / 6.283;
    x.emplace_back(radius * std::cos(angle), radius * std::sin(angle), surfaces.rest[v].z());
  }
  return x;
}

std::vector<Vec3> turning(const std::vector<Vec3>& x, const Vec3& turn, const Vec3& shift, double noise,
                          unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-noise, noise);
  std::vector<Vec3> moves;
  for (const Vec3& p : x)
    moves.push_back(turn.cross(p) + shift + Vec3(coordinate(random), coordinate(random), coordinate(random)));
  return moves;
}

using Key = std::tuple<int, int, int>;  // kind, features

std::set<Key> found(const ContactCandidates& candidates) {
  std::set<Key> keys;
  for (const Candidate& c : candidates.point_triangle()) keys.insert({0, c.a, c.b});
  for (const Candidate& c : candidates.edge_edge()) keys.insert({1, std::min(c.a, c.b), std::max(c.a, c.b)});
  return keys;
}

/// Pairs that come within reach at one of eleven moments of the way, and were not close at rest.
std::set<Key> within_reach(const ContactSurfaces& s, const std::vector<Vec3>& x, const std::vector<Vec3>& move) {
  std::set<Key> keys;
  const auto look = [&](PairKind kind, int a, int b, const std::array<int, 4>& v) {
    if (v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3]) return;
    if (kind == PairKind::kPointTriangle && v[0] == v[1]) return;
    FourPoints rest, at;
    for (size_t i = 0; i < 4; ++i) rest[i] = s.rest[static_cast<size_t>(v[i])];
    if (pair_distance(kind, rest) < 2 * kReach) return;
    for (int k = 0; k <= 10; ++k) {
      for (size_t i = 0; i < 4; ++i) at[i] = x[static_cast<size_t>(v[i])] + 0.1 * k * move[static_cast<size_t>(v[i])];
      if (pair_distance(kind, at) < kReach) {
        keys.insert({kind == PairKind::kPointTriangle ? 0 : 1, a, b});
        return;
      }
    }
  };
  for (int v = 0; v < s.vertices(); ++v)
    for (size_t t = 0; t < s.triangles.size(); ++t)
      look(PairKind::kPointTriangle, v, static_cast<int>(t),
           {v, s.triangles[t][0], s.triangles[t][1], s.triangles[t][2]});
  for (size_t e = 0; e < s.edges.size(); ++e)
    for (size_t f = e + 1; f < s.edges.size(); ++f)
      look(PairKind::kEdgeEdge, static_cast<int>(e), static_cast<int>(f),
           {s.edges[e][0], s.edges[e][1], s.edges[f][0], s.edges[f][1]});
  return keys;
}

}  // namespace

TEST_CASE("no pair that comes within reach is missing, however surfaces move, turn and warp") {
  const ContactSurfaces surfaces = two_sheets();
  const std::vector<Vec3> x = rolled(surfaces, 0.012);
  unsigned seed = 0;
  for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(0, 0, 0.3), Vec3(0.4, -0.2, 0.1), Vec3(2, 1, 0)})
    for (const double noise : {0.0, 2e-3, 0.02}) {
      CAPTURE(turn.transpose());
      CAPTURE(noise);
      ContactCandidates candidates(surfaces, kReach);
      const std::vector<Vec3> move = turning(x, turn, Vec3(0.3, -2, 0.1), noise, ++seed);
      candidates.begin(x, move);
      const std::set<Key> have = found(candidates), need = within_reach(surfaces, x, move);
      REQUIRE(need.size() > 50);
      CHECK(std::includes(have.begin(), have.end(), need.begin(), need.end()));
      // Places beside the way, as far as the set reaches.
      std::vector<Vec3> beside = x;
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> coordinate(-1, 1);
      for (size_t v = 0; v < x.size(); ++v)
        beside[v] +=
            0.7 * move[v] + 1.9e-3 * Vec3(coordinate(random), coordinate(random), coordinate(random)).normalized();
      if (candidates.cover(beside, std::vector<Vec3>(x.size(), Vec3::Zero()))) continue;
      const std::set<Key> near = within_reach(surfaces, beside, std::vector<Vec3>(x.size(), Vec3::Zero()));
      CHECK(std::includes(have.begin(), have.end(), near.begin(), near.end()));
    }
}

TEST_CASE("a flat sheet has no candidates, at any speed and however fast it turns") {
  const TriangleMesh sheet = grid_sheet(1, 1, 20, 20);
  const ContactSurfaces surfaces({{"sheet", 0, sheet.vertices, sheet.triangles, {}, 0, 0, true, true}}, {});
  ContactCandidates candidates(surfaces, 2e-3);
  for (const Vec3& turn : {Vec3(0, 0.2, 0), Vec3(0.3, 0, 0), Vec3(-0.1, 0.2, 0.3)}) {
    candidates.begin(sheet.vertices, turning(sheet.vertices, turn, Vec3(0, -5, 0), 1e-4, 1));
    CHECK(candidates.count() == 0);
  }
}
