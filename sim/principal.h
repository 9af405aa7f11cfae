#pragma once
// Principal stretches of a deformation gradient, and Hessians of isotropic energies written in them.
// D = 3: a solid, F is 3x3. D = 2: a surface, F is 3x2.
#include <Eigen/Core>

namespace softreel::sim {

template <int D>
using Deformation = Eigen::Matrix<double, 3, D>;
template <int D>
using Stretches = Eigen::Matrix<double, D, 1>;

/// F = U.leftCols(D) diag(sigma) V^T, finite for every finite F, the zero matrix included.
/// Solid: U, V rotations; sigma_0 >= sigma_1 >= |sigma_2|, only sigma_2 may be negative (reflection).
/// Surface: sigma_0 >= sigma_1 >= 0, U a rotation whose last column is the surface's normal.
template <int D>
struct Principal {
  Eigen::Matrix3d U;
  Stretches<D> sigma;
  Eigen::Matrix<double, D, D> V;
};
Principal<3> principal_stretches(const Deformation<3>& F);
Principal<2> principal_stretches(const Deformation<2>& F);

/// d2 psi / dF2 of an isotropic energy in the principal frame (Smith, de Goes, Kim 2019, "Analytic eigensystems for
/// isotropic distortion energies"): D stretching modes coupled by a matrix, and for each pair (i, j) of axes of space,
/// named by the third axis k, the eigenvalues of the symmetric (e_i e_j^T + e_j e_i^T) and the antisymmetric mode.
/// A surface has sigma_2 = psi_2 = 0: both eigenvalues of its pairs with the normal are psi_i / sigma_i.
template <int D>
struct PrincipalHessian {
  Eigen::Matrix<double, D, D> stretch;  ///< d2 psi / d sigma_i d sigma_j [Pa]
  Eigen::Vector3d symmetric;            ///< (psi_i - psi_j) / (sigma_i - sigma_j) [Pa]
  Eigen::Vector3d antisymmetric;        ///< (psi_i + psi_j) / (sigma_i + sigma_j) [Pa]
};

/// Sets negative eigenvalues to zero; exact where there are none.
void clamp(PrincipalHessian<3>& hessian);
void clamp(PrincipalHessian<2>& hessian);

}  // namespace softreel::sim
