#include "sim/rigid_modes.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b, int first, int count) {
  return parallel_sum(count, Work::kVector, [&](int i) { return a(first + i) * b(first + i); });
}

}  // namespace

std::array<Eigen::VectorXd, 6> rigid_modes(const LinearTargets& targets) {
  const Eigen::VectorXd& y = *targets.positions;
  std::array<Eigen::VectorXd, 6> Z;
  for (auto& mode : Z) mode.setZero(y.size());
  for (const BodyRange& body : targets.bodies) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int i = body.first; i < body.first + body.count; ++i) centre += y.segment<3>(3 * i);
    centre /= body.count;
    for (int i = body.first; i < body.first + body.count; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
        Z[static_cast<size_t>(axis)].segment<3>(3 * i) = e;
        Z[static_cast<size_t>(axis) + 3].segment<3>(3 * i) = e.cross(y.segment<3>(3 * i) - centre);
      }
  }
  if (targets.held)
    for (auto& mode : Z)
      for (size_t i = 0; i < targets.held->size(); ++i)
        if ((*targets.held)[i]) mode(static_cast<Eigen::Index>(i)) = 0;
  return Z;
}

void correct_rigid_modes(const BlockMatrix& A, const Eigen::VectorXd& b, const LinearTargets& targets,
                         Eigen::VectorXd& x) {
  if (!targets.positions) return;
  const std::array<Eigen::VectorXd, 6> Z = rigid_modes(targets);
  std::array<Eigen::VectorXd, 6> AZ;
  for (auto& product : AZ) product.resize(b.size());
  Eigen::VectorXd r(b.size());
  for (const BodyRange& body : targets.bodies) {
    const int first = 3 * body.first, count = 3 * body.count;
    // Bodies may be tied to each other: the modes of this one alone, and the residual that the others have left.
    parallel_for(body.count, Work::kRow, [&](int k) {
      const int i = body.first + k;
      Eigen::Matrix<double, 3, 6> own = Eigen::Matrix<double, 3, 6>::Zero();
      Eigen::Vector3d rest = b.segment<3>(3 * i);
      for (int at = A.row_start[static_cast<size_t>(i)]; at < A.row_start[static_cast<size_t>(i) + 1]; ++at) {
        const int column = A.column[static_cast<size_t>(at)];
        rest -= A.block(at) * x.segment<3>(3 * column);
        if (column < body.first || column >= body.first + body.count) continue;
        for (size_t m = 0; m < 6; ++m)
          own.col(static_cast<Eigen::Index>(m)) += A.block(at) * Z[m].segment<3>(3 * column);
      }
      r.segment<3>(3 * i) = rest;
      for (size_t m = 0; m < 6; ++m) AZ[m].segment<3>(3 * i) = own.col(static_cast<Eigen::Index>(m));
    });
    Eigen::Matrix<double, 6, 6> gram;
    Eigen::Matrix<double, 6, 1> right;
    for (size_t m = 0; m < 6; ++m) {
      const auto row = static_cast<Eigen::Index>(m);
      right(row) = dot(Z[m], r, first, count);
      for (size_t k = 0; k < 6; ++k) gram(row, static_cast<Eigen::Index>(k)) = dot(Z[m], AZ[k], first, count);
    }
    // A body of one or two points has fewer modes: the pivoted factorization leaves out what is dependent.
    const Eigen::Matrix<double, 6, 1> step = gram.completeOrthogonalDecomposition().solve(right);
    if (!step.allFinite()) continue;
    for (size_t m = 0; m < 6; ++m)
      x.segment(first, count) += step(static_cast<Eigen::Index>(m)) * Z[m].segment(first, count);
  }
}

}  // namespace softreel::sim
