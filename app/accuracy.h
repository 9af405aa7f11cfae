#pragma once
// What time.accuracy asks for, in the units of what is simulated.
#include <Eigen/Core>
#include <vector>

#include "app/clip_cache.h"
#include "app/shapes.h"
#include "assets/scene.h"

namespace softreel::app {

/// Errors that count as 1.
struct AccuracyTarget {
  double length = 0;    ///< RMS over the vertices of all bodies [m]; 0: there is no body
  double of_range = 0;  ///< RMS over the vertices of a field, as a part of its range; 0: there is no field
};

/// `start`: frame 1. Pixels are those at the distance of the camera from the middle of the scene; an automatic camera
/// is taken as it frames the start. Throws UserError (kUsage) for a part of a scene without size, and for pixels where
/// the camera stands in the middle of the scene.
AccuracyTarget accuracy_target(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& start);

/// Ranges of the values of fields over the frames that were added.
class FieldSpans {
 public:
  void add(const CachedFrame& frame);
  double of(size_t field) const { return high_[field] - low_[field]; }

 private:
  std::vector<double> low_, high_;
};

/// The solution of a frame, scaled so that the norm of a difference is the error, 1 where it is as large as was asked.
/// Of several parts (all bodies together, each field) the squares add up, so no part is above what the norm says.
Eigen::VectorXd scaled_solution(const CachedFrame& frame, const AccuracyTarget& target, const FieldSpans& spans);

}  // namespace softreel::app
