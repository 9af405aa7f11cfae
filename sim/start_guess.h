#pragma once
// Where the solve of an implicit step may begin, nearer to its end than the motion without forces.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/implicit_method.h"

namespace softreel::sim {

/// Carries the acceleration on: every implicit method moves y away from y_tilde by beta times an acceleration, so
/// y_tilde + beta (a + (h/h_last) (a - a_last)) is off by O(h^2) of it where the motion is smooth. Only a guess, so
/// single precision is enough.
class StartGuess {
 public:
  bool any() const { return last_.size() > 0; }
  /// y, 3n [m], for a stage of a step of h [s]; needs any().
  void guess(const Stage& stage, double h, Eigen::VectorXd& y) const;
  /// Takes note of a step that ended at y.
  void accept(const Stage& stage, double h, const Eigen::VectorXd& y);
  void forget();

  std::vector<double> memory() const;
  /// Takes its part from the front of `saved` and returns the rest. Throws std::invalid_argument for what is not of
  /// `size` coordinates.
  std::span<const double> restore(std::span<const double> saved, Eigen::Index size);

 private:
  Eigen::VectorXf last_, before_;  // accelerations of the last step and the one before it, 3n [m/s^2], or empty
  double h_ = 0;                   // from the one before to the last [s]
};

}  // namespace softreel::sim
