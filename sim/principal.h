#pragma once
// Principal stretches of a deformation gradient, and Hessians of isotropic energies written in them.
#include <Eigen/Core>

namespace softreel::sim {

/// F = U diag(sigma) V^T with U, V rotations; |sigma_0| >= |sigma_1| >= |sigma_2|, only sigma_2 may be negative
/// (reflection). Finite for every finite F, the zero matrix included.
struct Principal3 {
  Eigen::Matrix3d U;
  Eigen::Vector3d sigma;
  Eigen::Matrix3d V;
};
Principal3 principal_stretches(const Eigen::Matrix3d& F);

/// Surface: F (3x2) = U.leftCols(2) diag(sigma) V^T, sigma_0 >= sigma_1 >= 0, U a rotation whose last column is
/// the surface's normal.
struct Principal2 {
  Eigen::Matrix3d U;
  Eigen::Vector2d sigma;
  Eigen::Matrix2d V;
};
Principal2 principal_stretches(const Eigen::Matrix<double, 3, 2>& F);

/// d2 psi / dF2 of an isotropic energy in the principal frame (Smith, de Goes, Kim 2019, "Analytic eigensystems for
/// isotropic distortion energies"): three stretching modes coupled by a 3x3 matrix, and for each pair (i, j) of axes,
/// named by the third axis k, the eigenvalues of the symmetric (e_i e_j^T + e_j e_i^T) and the antisymmetric mode.
struct PrincipalHessian3 {
  Eigen::Matrix3d stretch;        ///< d2 psi / d sigma_i d sigma_j [Pa]
  Eigen::Vector3d symmetric;      ///< (psi_i - psi_j) / (sigma_i - sigma_j) [Pa]
  Eigen::Vector3d antisymmetric;  ///< (psi_i + psi_j) / (sigma_i + sigma_j) [Pa]
};

/// The same for a surface (F is 3x2): besides, the two modes n e_i^T out of the surface.
struct PrincipalHessian2 {
  Eigen::Matrix2d stretch;
  double symmetric = 0;
  double antisymmetric = 0;
  Eigen::Vector2d normal;  ///< psi_i / sigma_i [Pa]
};

/// Sets negative eigenvalues to zero; exact where there are none.
void clamp(PrincipalHessian3& hessian);
void clamp(PrincipalHessian2& hessian);

}  // namespace softreel::sim
