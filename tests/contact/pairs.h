#pragma once
// Pairs of features in every region of their distance.
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "sim/contact/pair_energy.h"

namespace softreel::tests {

struct NamedPair {
  std::string region;
  sim::PairKind kind;
  sim::FourPoints x;
};

/// Random pairs, sorted by the region that their nearest points are in: `each` of every one of them.
inline std::vector<NamedPair> pairs_of_every_region(int each, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<NamedPair> result;
  std::map<std::string, int> count;
  for (const sim::PairKind kind : {sim::PairKind::kPointTriangle, sim::PairKind::kEdgeEdge})
    for (int trial = 0; trial < 20000; ++trial) {
      sim::FourPoints x;
      for (auto& p : x) p = {coordinate(random), coordinate(random), coordinate(random)};
      const sim::ClosestPoints c = sim::closest_points(kind, x);
      std::string region = kind == sim::PairKind::kPointTriangle ? "point-triangle" : "edge-edge";
      for (const double w : c.weights) region += w == 0 ? " 0" : (std::abs(w) == 1 ? " 1" : " w");
      if (c.distance < 0.05 || count[region]++ >= each) continue;
      result.push_back({region, kind, x});
    }
  return result;
}

}  // namespace softreel::tests
