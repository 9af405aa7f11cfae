#pragma once
// Fills the cache of a clip, from where it stands.
#include <functional>
#include <string>
#include <vector>

#include "app/clip_cache.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/step_report.h"

namespace softreel::app {

struct ClipRun {
  int frames_from_cache = 0;
  int frames_simulated = 0;
  sim::StepReport total;  ///< of what was simulated in this run
  double seconds = 0;     ///< wall [s]
  std::string solver;     ///< linear solver that was chosen last; empty: none
  int vertices = 0;
};

/// Simulates frames up to `last`, each written to the cache as soon as it is complete. Throws UserError (kSimulation)
/// with the frame, the reason and what to change when a step does not hold; Interrupted.
ClipRun simulate_clip(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache, int last, bool quiet);

}  // namespace softreel::app
