#include "sim/adaptive_figures.h"

#include <algorithm>

namespace softreel::sim {

AdaptiveRecorder::AdaptiveRecorder(int order, size_t earlier) : order_(static_cast<size_t>(order)) {
  so_far_.differences.resize(earlier);
}

void AdaptiveRecorder::add(const Eigen::VectorXd& y, const std::vector<const Eigen::VectorXd*>& earlier) {
  for (size_t i = 0; i < so_far_.differences.size(); ++i)
    if (earlier.at(i)) so_far_.differences[i].push_back((y - *earlier[i]).norm());
  if (last_.empty()) {
    first_ = y;
  } else {
    so_far_.path += (y - last_.back()).norm();
    so_far_.amplitude = std::max(so_far_.amplitude, (y - first_).norm());
    so_far_.local.push_back(0);
  }
  last_.push_back(y);
  if (last_.size() < order_ + 2) return;
  // sum_k (-1)^k binomial(p + 1, k) y_(f - k)
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(y.size());
  double binomial = 1;
  for (size_t k = 0; k <= order_ + 1; ++k) {
    difference += (k % 2 == 0 ? binomial : -binomial) * last_[order_ + 1 - k];
    binomial *= static_cast<double>(order_ + 1 - k) / static_cast<double>(k + 1);
  }
  const double norm = difference.norm();
  for (size_t i = so_far_.local.size() - (order_ + 1); i < so_far_.local.size(); ++i)
    so_far_.local[i] = std::max(so_far_.local[i], norm);
  last_.pop_front();
}

AdaptiveFigures AdaptiveRecorder::figures() const {
  AdaptiveFigures figures = so_far_;
  // In a clip too short for one difference, or that a method of this order follows exactly, all intervals are alike.
  if (std::all_of(figures.local.begin(), figures.local.end(), [](double l) { return l == 0; }))
    std::fill(figures.local.begin(), figures.local.end(), 1.0);
  return figures;
}

}  // namespace softreel::sim
