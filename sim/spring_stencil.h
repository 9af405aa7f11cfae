#pragma once
// What terms over the two ends of springs have in common.
#include <vector>

#include "sim/element_term.h"
#include "sim/springs.h"

namespace softreel::sim {

/// out := [[K, -K], [-K, K]], of a function of the difference of two vertices.
inline void spring_block(const Eigen::Matrix3d& K, ElementHessian<2>& out) {
  out.block<3, 3>(0, 0) = K;
  out.block<3, 3>(3, 3) = K;
  out.block<3, 3>(0, 3) = -K;
  out.block<3, 3>(3, 0) = -K;
}

/// Two vertices for each spring.
inline std::vector<int> spring_stencils(const std::vector<Spring>& springs) {
  std::vector<int> stencils;
  stencils.reserve(springs.size() * 2);
  for (const Spring& s : springs) stencils.insert(stencils.end(), {s.a, s.b});
  return stencils;
}

}  // namespace softreel::sim
