#pragma once
// Shapes and measures of the stress tests.
#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "sim/grids.h"
#include "sim/principal.h"
#include "tests/sim/support.h"

namespace softreel::tests {

/// Tetrahedra of `mesh` that are flat or inverted at x.
inline int inverted(const sim::TetMesh& mesh, const Eigen::VectorXd& x) {
  int count = 0;
  for (const sim::Tet& t : mesh.tets) {
    const auto p = [&](size_t a) { return sim::Vec3(x.segment<3>(3 * t[a])); };
    count += sim::tet_volume(p(0), p(1), p(2), p(3)) > 0 ? 0 : 1;
  }
  return count;
}

/// Root mean square distance between x and the rest shape, up to the best rigid motion (Kabsch 1976).
inline double rms_from_rest(const Eigen::VectorXd& x, const Eigen::VectorXd& rest) {
  const Eigen::Index n = x.size() / 3;
  const Eigen::Map<const Eigen::Matrix3Xd> X(x.data(), 3, n), R(rest.data(), 3, n);
  const Eigen::Vector3d x_mean = X.rowwise().mean(), r_mean = R.rowwise().mean();
  const Eigen::Matrix3d covariance = (X.colwise() - x_mean) * (R.colwise() - r_mean).transpose();
  const sim::Principal<3> p = sim::principal_stretches(sim::Deformation<3>(covariance));
  const Eigen::Matrix3d rotation = p.U * p.V.transpose();
  return std::sqrt(((X.colwise() - x_mean) - rotation * (R.colwise() - r_mean)).squaredNorm() / static_cast<double>(n));
}

inline double volume(const sim::TetMesh& mesh, const Eigen::VectorXd& x) {
  double sum = 0;
  for (const sim::Tet& t : mesh.tets) {
    const auto p = [&](size_t a) { return sim::Vec3(x.segment<3>(3 * t[a])); };
    sum += sim::tet_volume(p(0), p(1), p(2), p(3));
  }
  return sum;
}

}  // namespace softreel::tests
