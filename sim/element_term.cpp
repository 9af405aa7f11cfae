#include "sim/element_term.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <numeric>

namespace softreel::sim {

VertexSlots::VertexSlots(std::span<const int> stencils) : slots_(stencils.size()) {
  std::iota(slots_.begin(), slots_.end(), 0);
  std::stable_sort(slots_.begin(), slots_.end(),
                   [&](int a, int b) { return stencils[static_cast<size_t>(a)] < stencils[static_cast<size_t>(b)]; });
  for (size_t i = 0; i < slots_.size(); ++i) {
    const int vertex = stencils[static_cast<size_t>(slots_[i])];
    if (vertices_.empty() || vertices_.back() != vertex) {
      vertices_.push_back(vertex);
      first_.push_back(static_cast<int>(i));
    }
  }
  first_.push_back(static_cast<int>(slots_.size()));
}

void VertexSlots::add(const std::vector<double>& slots, Eigen::VectorXd& target) const {
  parallel_for(static_cast<int>(vertices_.size()), Work::kRow, [&](int i) {
    const auto k = static_cast<size_t>(i);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int s = first_[k]; s < first_[k + 1]; ++s)
      sum += Eigen::Map<const Eigen::Vector3d>(slots.data() + 3 * static_cast<size_t>(slots_[static_cast<size_t>(s)]));
    target.segment<3>(3 * vertices_[k]) += sum;
  });
}

template <int N>
void clamp_to_semidefinite(Eigen::Matrix<double, N, N>& symmetric) {
  if constexpr (N <= 3) {  // the usual case, positive definite, seen from the leading minors
    const double minor = symmetric(0, 0) * symmetric(1, 1) - symmetric(0, 1) * symmetric(1, 0);
    if (symmetric(0, 0) > 0 && minor > 0 && (N == 2 || symmetric.determinant() > 0)) return;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(symmetric);
  const auto& values = eigen.eigenvalues();
  // Rounding makes tiny negative values of what is semi-definite: those leave the matrix as it is.
  if (values(0) >= -1e-14 * values.cwiseAbs().maxCoeff()) return;
  symmetric = eigen.eigenvectors() * values.cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

template void clamp_to_semidefinite<2>(Eigen::Matrix2d&);
template void clamp_to_semidefinite<3>(Eigen::Matrix3d&);
template void clamp_to_semidefinite<12>(Eigen::Matrix<double, 12, 12>&);

}  // namespace softreel::sim
