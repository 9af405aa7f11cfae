#include "sim/lanczos.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace softreel::sim {
namespace {

/// Uniform in [-1, 1], from the index alone (splitmix64; Steele, Lea, Flood 2014).
double random_entry(std::uint64_t index) {
  std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-52 - 1;
}

}  // namespace

RitzPair largest_eigenpair(const SymmetricPencil& pencil, double tolerance, int most_products) {
  RitzPair best;
  Eigen::VectorXd start(pencil.size);
  for (Eigen::Index i = 0; i < pencil.size; ++i) start(i) = random_entry(static_cast<std::uint64_t>(i));
  pencil.solve_mass(start);  // light vertices, which are often the fastest, get their share; what is held, nothing
  best.vector = Eigen::VectorXd::Zero(pencil.size);

  std::vector<Eigen::VectorXd> q, Mq;
  Eigen::VectorXd Kq(pencil.size), Mr(pencil.size);
  while (true) {
    q.clear();
    Mq.clear();
    std::vector<double> diagonal, beside;
    Eigen::VectorXd r = start;
    pencil.mass(r, Mr);
    double norm = std::sqrt(std::max(0.0, r.dot(Mr)));
    if (!(norm > 0)) return best;
    while (true) {
      q.push_back(r / norm);
      Mq.push_back(Mr / norm);
      pencil.stiffness(q.back(), Kq);
      ++best.products;
      diagonal.push_back(q.back().dot(Kq));
      r = Kq;
      pencil.solve_mass(r);
      // Twice is enough (Parlett 1998, section 6.9).
      for (int pass = 0; pass < 2; ++pass)
        for (size_t k = q.size(); k-- > 0;) r -= Mq[k].dot(r) * q[k];
      pencil.mass(r, Mr);
      norm = std::sqrt(std::max(0.0, r.dot(Mr)));

      const auto n = static_cast<Eigen::Index>(diagonal.size());
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small;
      small.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                   Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1));
      best.value = small.eigenvalues()(n - 1);
      const Eigen::VectorXd weights = small.eigenvectors().col(n - 1);
      best.residual = norm * std::abs(weights(n - 1));
      const double rounding = 8 * std::numeric_limits<double>::epsilon() * small.eigenvalues().cwiseAbs().maxCoeff();
      const bool done = best.residual <= std::max(tolerance * best.value, rounding) || norm <= rounding ||
                        best.products >= most_products;
      if (!done && n < kLanczosVectors) {
        beside.push_back(norm);
        continue;
      }
      start.setZero();
      for (size_t k = 0; k < q.size(); ++k) start += weights(static_cast<Eigen::Index>(k)) * q[k];
      if (!done) break;
      best.vector = start;
      return best;
    }
  }
}

}  // namespace softreel::sim
