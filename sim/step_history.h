#pragma once
// What a method with memory keeps of its last step.
#include <Eigen/Core>
#include <array>
#include <span>
#include <stdexcept>
#include <vector>

namespace softreel::sim {

/// N vectors of one size and the length of the step they come from.
template <size_t N>
struct StepHistory {
  double h = 0;  ///< [s]; 0: nothing is kept
  std::array<Eigen::VectorXd, N> vectors;

  std::vector<double> memory() const {
    std::vector<double> saved;
    if (h == 0) return saved;
    saved.push_back(h);
    for (const Eigen::VectorXd& v : vectors) saved.insert(saved.end(), v.begin(), v.end());
    return saved;
  }

  void restore(std::span<const double> saved) {
    h = 0;
    if (saved.empty()) return;
    const size_t size = (saved.size() - 1) / N;
    if (saved.size() != 1 + N * size) throw std::invalid_argument("memory of another integrator");
    h = saved[0];
    for (size_t i = 0; i < N; ++i)
      vectors[i] = Eigen::Map<const Eigen::VectorXd>(saved.data() + 1 + i * size, static_cast<Eigen::Index>(size));
  }
};

}  // namespace softreel::sim
