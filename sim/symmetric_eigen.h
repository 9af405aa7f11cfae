#pragma once
// Eigenvalues and eigenvectors of a symmetric 3x3 matrix, without iterating over rotations.
#include <Eigen/Core>

namespace softreel::sim {

/// S = V diag(values) V^T, values descending, V a rotation; errors are a few roundings of |S|. Two or three times as
/// fast as Jacobi rotations. After Eberle 2021, "A robust eigensolver for 3x3 symmetric matrices", sections 2 to 4.
void symmetric_eigen(const Eigen::Matrix3d& S, Eigen::Vector3d& values, Eigen::Matrix3d& V);

}  // namespace softreel::sim
