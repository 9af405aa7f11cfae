#pragma once
// Linear finite elements for scalar fields on triangle meshes, flat or curved: step 2 (elements) and 3 (assembly) of
// the six in field.h.
//
// On every triangle the field is the linear combination of three hat functions N_i (1 at vertex i, 0 at the two
// others). Their gradients lie in the triangle's own plane, so that on a curved surface the same matrices are those of
// the Laplace-Beltrami operator (Dziuk 1988).
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <functional>

#include "sim/mesh.h"

namespace softreel::sim {

using ScalarMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A scalar over space [m] and time [s]; zero where `value` is empty. Called by several threads at a time.
struct FieldFunction {
  std::function<double(const Vec3& x, double t)> value;
  bool varies = false;  ///< with t

  double operator()(const Vec3& x, double t) const { return value ? value(x, t) : 0.0; }
};

enum class FieldMass { kLumped, kConsistent };

/// One element: its area and the gradients of its hat functions.
struct HatTriangle {
  double area = 0;               ///< [m^2]
  std::array<Vec3, 3> gradient;  ///< [1/m], in the plane of the triangle
};

/// Throws std::invalid_argument if the triangle has no area.
HatTriangle hat_triangle(const TriangleMesh& mesh, int triangle);

/// K_ij = sum_e A_e grad N_i . grad N_j, n x n [-], summed over the elements in their order. Row sums are zero.
/// Throws std::invalid_argument for a triangle without area and for a vertex that no triangle uses.
ScalarMatrix assemble_stiffness(const TriangleMesh& mesh);

/// M_ij = sum_e integral of N_i N_j, n x n [m^2]: (A_e/12)(1 + delta_ij); lumped: its row sums, A_e/3 to each vertex.
ScalarMatrix assemble_mass(const TriangleMesh& mesh, FieldMass mass);

/// f_j = sum_e A_e f(centroid, t)/3, n: one-point quadrature, exact for f constant on each element. Writes `load`.
void assemble_load(const TriangleMesh& mesh, const FieldFunction& f, double t, Eigen::VectorXd& load);

/// y = A x; the same bits for any number of threads.
void multiply(const ScalarMatrix& A, const Eigen::VectorXd& x, Eigen::VectorXd& y);

}  // namespace softreel::sim
