#pragma once
// Looks at a simulation from frame to frame: what turned inside out, and whether energy comes from nowhere.
#include <optional>
#include <string>
#include <vector>

#include "app/clip_cache.h"
#include "app/shapes.h"
#include "assets/scene.h"

namespace softreel::app {

/// Tetrahedra whose volume is not positive, of each soft body. `x`: 3n positions of the state [m].
std::vector<int> inverted_tets(const Shapes& shapes, const Eigen::VectorXd& x);

/// Stops what blows up before positions run away: explicit methods, in scenes that nothing drives, once energy has come
/// from nowhere, many times all that was ever in motion; and any method once a tenth of the momentum is lost or found
/// (MomentumWatch).
class RunWatch {
 public:
  /// Both must outlive this.
  RunWatch(const assets::Scene& scene, const Shapes& shapes);

  /// Fills frame.figures.inverted; why the run should stop, or nothing. Frames come in their order.
  std::optional<std::string> look(CachedFrame& frame);

 private:
  const assets::Scene& scene_;
  const Shapes& shapes_;
  bool energy_is_kept_;
  std::optional<double> start_;  // total energy of the first frame seen [J]
  double in_motion_ = 0;         // the most of kinetic, elastic and contact energy in any frame before [J]
};

struct Cause {
  std::string text;      ///< sentences for the user, each ended by "; "
  bool advises = false;  ///< they name a setting that helps
};

/// Where a run that failed was at its worst, and what most likely made it fail. `last`: the last frame that held.
Cause likely_cause(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& last);

}  // namespace softreel::app
