#pragma once
// Fills the cache of a clip with steps that time.accuracy asks for (sim/adaptive_plan.h).
#include <string>

#include "app/simulate_clip.h"

namespace softreel::app {

/// As simulate_clip, of the whole clip: which steps a frame takes is known when the whole clip has been run with fewer.
/// Each run has a cache of its own beside that of the clip, so an interrupted one goes on to the same bits; when the
/// last one is good enough, its frames go to `cache` and the others are removed.
ClipRun simulate_to_accuracy(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache, bool quiet);

/// What `check` can say of a run whose number of steps is not known before it.
std::string accurate_steps_text(const assets::Scene& scene, const Shapes& shapes);

}  // namespace softreel::app
