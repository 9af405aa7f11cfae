#pragma once
// The largest eigenvalue of K q = lambda M q by Lanczos' method: some dozens of products, with a bound on the error.
#include <Eigen/Core>
#include <functional>

namespace softreel::sim {

/// K symmetric, M symmetric positive definite, over vectors of `size` entries. What is held is 0 in everything that
/// `stiffness` and `solve_mass` write.
struct SymmetricPencil {
  Eigen::Index size = 0;
  std::function<void(const Eigen::VectorXd& q, Eigen::VectorXd& out)> stiffness;  ///< out = K q
  std::function<void(const Eigen::VectorXd& q, Eigen::VectorXd& out)> mass;       ///< out = M q
  std::function<void(Eigen::VectorXd& f)> solve_mass;                             ///< f := M^-1 f
};

struct RitzPair {
  double value = 0;        ///< q^T K q / q^T M q: never above the largest eigenvalue
  double residual = 0;     ///< |M^-1 K q - value q|_M: an eigenvalue lies within so much of `value`
  Eigen::VectorXd vector;  ///< q, |q|_M = 1; zero if nothing is free
  int products = 0;        ///< with K
};

/// Lanczos' method in the inner product of M with full reorthogonalization (Parlett 1998, sections 13.1 and 13.8),
/// begun again from its best vector when kLanczosVectors are full, until residual <= tolerance * value or after
/// `most_products`. It begins with a vector of seeded random numbers: the same bits in every run, and no eigenvector is
/// orthogonal to it but by accident (Kuczynski, Wozniakowski 1992).
RitzPair largest_eigenpair(const SymmetricPencil& pencil, double tolerance = 5e-3, int most_products = 300);

/// Vectors that are kept at once.
inline constexpr int kLanczosVectors = 32;

}  // namespace softreel::sim
