#pragma once
// The generic derivative test: every term gets it by one line.
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>
#include <vector>

#include "sim/energy_term.h"

namespace softreel::tests {

/// The Hessian of one stencil, 3k x 3k, out of the blocks of all.
inline Eigen::MatrixXd element_matrix(const std::vector<double>& blocks, size_t element, int k) {
  Eigen::MatrixXd H(3 * k, 3 * k);
  const double* block = blocks.data() + element * static_cast<size_t>(sim::hessian_doubles(k));
  for (int a = 0; a < k; ++a)
    for (int b = a; b < k; ++b, block += 9) {
      const Eigen::Map<const Eigen::Matrix3d> B(block);
      H.block<3, 3>(3 * a, 3 * b) = B;
      H.block<3, 3>(3 * b, 3 * a) = B.transpose();
    }
  return H;
}

inline std::vector<double> all_blocks(const sim::EnergyTerm& term, const Eigen::VectorXd& q, sim::Definiteness d) {
  const auto k = static_cast<size_t>(term.stencil_size());
  if (k == 0) return {};
  std::vector<double> blocks(term.stencils().size() / k *
                             static_cast<size_t>(sim::hessian_doubles(term.stencil_size())));
  sim::all_element_hessians(term, q, 1.0, d, blocks.data());
  return blocks;
}

inline Eigen::MatrixXd dense_hessian(const sim::EnergyTerm& term, const Eigen::VectorXd& q, sim::Definiteness d) {
  const int k = term.stencil_size();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(q.size(), q.size());
  if (k == 0) return H;
  const std::vector<double> blocks = all_blocks(term, q, d);
  for (size_t e = 0; e < term.stencils().size() / static_cast<size_t>(k); ++e) {
    const Eigen::MatrixXd element = element_matrix(blocks, e, k);
    for (int a = 0; a < k; ++a)
      for (int b = 0; b < k; ++b)
        H.block<3, 3>(3 * term.stencils()[e * static_cast<size_t>(k) + static_cast<size_t>(a)],
                      3 * term.stencils()[e * static_cast<size_t>(k) + static_cast<size_t>(b)]) +=
            element.block<3, 3>(3 * a, 3 * b);
  }
  return H;
}

struct DerivativeErrors {
  double gradient = 0;            ///< relative to max(norm, scale)
  double hessian = 0;             ///< the same
  double most_negative = 0;       ///< smallest eigenvalue of the clamped Hessian, relative to its norm
  double clamping_of_convex = 0;  ///< largest |clamped - exact| of elements whose exact Hessian has no negative
                                  ///< eigenvalue, relative to its norm
  int convex_elements = 0;        ///< how many of those there were
};

/// Central differences of the value and the gradient at q. `scale`: what counts as zero force (gradient) and zero
/// stiffness (Hessian); `length`: the size of the elements, for the step of the differences.
inline DerivativeErrors derivative_errors(const sim::EnergyTerm& term, const Eigen::VectorXd& q, double force_scale,
                                          double stiffness_scale, double length, double gradient_step = 1e-6) {
  DerivativeErrors errors;
  const double h = gradient_step * length;
  Eigen::VectorXd g = Eigen::VectorXd::Zero(q.size()), numeric(q.size());
  term.add_gradient(q, g);
  Eigen::MatrixXd H_numeric(q.size(), q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    Eigen::VectorXd plus = q, minus = q;
    plus(i) += h;
    minus(i) -= h;
    const double width = plus(i) - minus(i);
    numeric(i) = (term.value(plus) - term.value(minus)) / width;
    Eigen::VectorXd gp = Eigen::VectorXd::Zero(q.size()), gm = gp;
    term.add_gradient(plus, gp);
    term.add_gradient(minus, gm);
    H_numeric.col(i) = (gp - gm) / width;
  }
  const Eigen::MatrixXd H = dense_hessian(term, q, sim::Definiteness::kExact);
  errors.gradient = (g - numeric).norm() / std::max(g.norm(), force_scale);
  errors.hessian = (H - H_numeric).norm() / std::max(H.norm(), stiffness_scale);
  const Eigen::MatrixXd C = dense_hessian(term, q, sim::Definiteness::kClamped);
  const double norm = std::max(C.norm(), 1e-300);
  errors.most_negative = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C).eigenvalues().minCoeff() / norm;
  const int k = term.stencil_size();
  if (k == 0) return errors;
  const std::vector<double> exact = all_blocks(term, q, sim::Definiteness::kExact);
  const std::vector<double> clamped = all_blocks(term, q, sim::Definiteness::kClamped);
  for (size_t e = 0; e < term.stencils().size() / static_cast<size_t>(k); ++e) {
    const Eigen::MatrixXd He = element_matrix(exact, e, k);
    if (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(He).eigenvalues().minCoeff() < -1e-13 * He.norm()) continue;
    ++errors.convex_elements;
    errors.clamping_of_convex =
        std::max(errors.clamping_of_convex, (element_matrix(clamped, e, k) - He).norm() / std::max(He.norm(), 1e-300));
  }
  return errors;
}

/// A stacked vector from points.
inline Eigen::VectorXd stacked(const std::vector<Eigen::Vector3d>& points) {
  Eigen::VectorXd q(3 * static_cast<Eigen::Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) q.segment<3>(3 * static_cast<Eigen::Index>(i)) = points[i];
  return q;
}

inline Eigen::VectorXd random_vector(Eigen::Index size, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  Eigen::VectorXd v(size);
  for (double& x : v) x = uniform(random);
  return v;
}

}  // namespace softreel::tests
