#pragma once
// What render and simulate have in common: read, check, load, simulate.
#include <filesystem>
#include <vector>

#include "app/arguments.h"
#include "app/clip_cache.h"
#include "app/shapes.h"
#include "app/stats.h"
#include "assets/scene.h"

namespace softreel::app {

/// Everything that is known before any work is done.
struct ClipPlan {
  assets::Scene scene;
  std::filesystem::path output;
  std::vector<int> frames;  ///< asked for
  ClipCache cache;
  bool force = false;  ///< simulate a hopeless setting too
  RunFigures figures;
};

/// Reads and checks the scene, makes the output folder (what cannot be written is found at once), hashes.
ClipPlan plan_clip(const ClipArguments& arguments);

/// Loads the shapes and simulates up to `last`. Fills plan.figures. Throws UserError (kUsage) where an explicit
/// method's step is hopeless, unless plan.force.
Shapes simulate_plan(ClipPlan& plan, int last, bool quiet);

/// Threads for the physics and, before the first picture, for llvmpipe.
void use_threads(int threads);

}  // namespace softreel::app
