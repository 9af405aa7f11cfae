#pragma once
// Nearest points of a point and a triangle, or of two edges, and what they depend on.
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace softreel::sim {

/// Which two features four vertices span: a point x0 and a triangle x1 x2 x3, or an edge x0 x1 and an edge x2 x3.
enum class PairKind : std::uint8_t { kPointTriangle, kEdgeEdge };

using FourPoints = std::array<Eigen::Vector3d, 4>;
using FourNumbers = std::array<double, 4>;

/// The vector between the nearest points is r = sum w_i x_i. Where the nearest points lie inside a feature they give
/// way, r = sum w_i(beta) x_i with as many parameters beta as they have freedom.
struct ClosestPoints {
  double distance = 0;                          ///< |r| [m]
  Eigen::Vector3d r = Eigen::Vector3d::Zero();  ///< from the second feature to the first [m]
  FourNumbers weights{};                        ///< w; their sum is zero
  int parameters = 0;                           ///< of beta: 0 between vertices, 1 vertex to edge, 2 inside both
  std::array<FourNumbers, 2> rates{};           ///< dw/dbeta, one for each parameter
};

/// The nearest points. Flat triangles and edges without length are allowed.
ClosestPoints closest_points(PairKind kind, const FourPoints& x);

/// Their distance alone [m]; less work.
double pair_distance(PairKind kind, const FourPoints& x);

}  // namespace softreel::sim
