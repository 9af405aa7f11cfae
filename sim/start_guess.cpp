#include "sim/start_guess.h"

#include <cstring>
#include <stdexcept>

namespace softreel::sim {
namespace {

/// Doubles that hold n floats.
size_t packed(size_t n) { return (n + 1) / 2; }

void append(std::vector<double>& saved, const Eigen::VectorXf& v) {
  const auto n = static_cast<size_t>(v.size());
  saved.push_back(static_cast<double>(n));
  saved.resize(saved.size() + packed(n), 0.0);
  if (n > 0) std::memcpy(saved.data() + saved.size() - packed(n), v.data(), n * sizeof(float));
}

std::span<const double> take(std::span<const double> saved, Eigen::Index size, Eigen::VectorXf& v) {
  const auto unfit = [] { throw std::invalid_argument("memory of another simulation"); };
  if (saved.empty() || (saved[0] != 0 && saved[0] != static_cast<double>(size))) unfit();
  const auto n = static_cast<size_t>(saved[0]);
  if (saved.size() < 1 + packed(n)) unfit();
  v.resize(static_cast<Eigen::Index>(n));
  if (n > 0) std::memcpy(v.data(), saved.data() + 1, n * sizeof(float));
  return saved.subspan(1 + packed(n));
}

}  // namespace

void StartGuess::guess(const Stage& stage, double h, Eigen::VectorXd& y) const {
  const double slope = before_.size() > 0 ? h / h_ : 0;
  y.resize(stage.y_tilde.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double a = last_(i), change = slope > 0 ? a - static_cast<double>(before_(i)) : 0;
    y(i) = stage.y_tilde(i) + stage.beta * (a + slope * change);
  }
}

void StartGuess::accept(const Stage& stage, double h, const Eigen::VectorXd& y) {
  before_.swap(last_);
  last_ = ((y - stage.y_tilde) / stage.beta).cast<float>();
  h_ = h;
}

void StartGuess::forget() {
  last_.resize(0);
  before_.resize(0);
}

std::vector<double> StartGuess::memory() const {
  std::vector<double> saved{h_};
  append(saved, last_);
  append(saved, before_);
  return saved;
}

std::span<const double> StartGuess::restore(std::span<const double> saved, Eigen::Index size) {
  if (saved.empty()) throw std::invalid_argument("memory of another simulation");
  h_ = saved[0];
  return take(take(saved.subspan(1), size, last_), size, before_);
}

}  // namespace softreel::sim
