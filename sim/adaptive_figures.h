#pragma once
// What one run of a clip shows about its own error, seen from its frames: how far it lies from earlier, coarser runs,
// and how hard each of its intervals is.
//
// Everything is a norm of the solution y of a frame, scaled so that 1 is the error that was asked for.
#include <Eigen/Core>
#include <deque>
#include <vector>

namespace softreel::sim {

struct AdaptiveFigures {
  std::vector<std::vector<double>> differences;  ///< [earlier run][frame that both visit] |y - y_earlier|
  /// [interval between two frames] norm of the backward difference of order p + 1 of the frames around it, the largest
  /// one that the interval has part in. It is proportional to the local error of a step of a method of order p, whose
  /// leading term is C h^(p+1) y^(p+1) (Hairer, Norsett, Wanner 1993, section II.4); where the motion is faster than
  /// the frames it no longer tells intervals apart.
  std::vector<double> local;
  double path = 0;       ///< sum of |y_(f+1) - y_f|
  double amplitude = 0;  ///< largest |y - y_first|
};

/// Collects the figures, one frame after the other; keeps p + 2 of them.
class AdaptiveRecorder {
 public:
  /// `order` p >= 1 of the method; `earlier`: how many earlier runs each frame is compared with.
  AdaptiveRecorder(int order, size_t earlier);

  /// `earlier`: the same frame of the earlier runs, as many as promised; null: that run does not visit it.
  void add(const Eigen::VectorXd& y, const std::vector<const Eigen::VectorXd*>& earlier);
  AdaptiveFigures figures() const;

 private:
  size_t order_;
  AdaptiveFigures so_far_;
  Eigen::VectorXd first_;
  std::deque<Eigen::VectorXd> last_;
};

}  // namespace softreel::sim
