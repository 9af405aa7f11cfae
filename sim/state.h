#pragma once
// The one flat state of everything that moves. A body is an index range.
#include <Eigen/Core>
#include <string>

namespace softreel::sim {

struct State {
  double t = 0;       ///< [s]
  Eigen::VectorXd x;  ///< positions, xyz per vertex, 3n [m]
  Eigen::VectorXd v;  ///< velocities, xyz per vertex, 3n [m/s]
};

/// Vertices [first, first + count) of the state.
struct BodyRange {
  std::string name;
  int first = 0;
  int count = 0;
};

}  // namespace softreel::sim
