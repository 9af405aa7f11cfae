#pragma once
// One variant of a scene, simulated in memory: for whoever compares settings.
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/clip_world.h"
#include "app/shapes.h"
#include "assets/scene.h"

namespace softreel::app {

struct TrialOptions {
  double seconds = std::numeric_limits<double>::infinity();  ///< wall, after which it is given up [s]
  /// Asked after every frame; what it answers is why the trial should stop, nothing: go on. `frame` is the clip's,
  /// from 1.
  std::function<std::string(const ClipWorld& world, int frame)> stop;
  int last_frame = 0;  ///< of the clip, from 1; 0: all of it
};

enum class TrialEnd {
  kRefused,  ///< could not begin: a setting that cannot hold
  kFailed,   ///< a step did not hold
  kStopped,  ///< by TrialOptions::stop
  kBudget,   ///< TrialOptions::seconds were over
};

struct TrialFailure {
  TrialEnd end = TrialEnd::kFailed;
  int frame = 1;    ///< on the way to which it ended, from 1
  double time = 0;  ///< start of the step that did not hold, or where it was stopped [s]
  long step = 0;    ///< of `scene.time.step()`, counted from 1; 0: none was taken
  std::string why;  ///< for the user
};

struct Trial {
  std::vector<CachedFrame> frames;  ///< from frame 1 (t = 0) on, as far as it came; without memory and field memory
  sim::StepReport total;
  double wall_seconds = 0;       ///< of the steps alone [s]
  double processor_seconds = 0;  ///< of all threads, in the steps alone [s]
  double setup_seconds = 0;      ///< wall, to build what is stepped [s]
  long peak_memory_bytes = 0;    ///< of the process while it ran; 0: the system does not tell
  std::optional<TrialFailure> failure;
};

/// Simulates `scene` from t = 0, without files. Steps that do not hold and settings that cannot be built are failures
/// of the trial, not exceptions. Throws Interrupted.
Trial run_trial(const assets::Scene& scene, const Shapes& shapes, const TrialOptions& options = {});

/// Shapes for variants of one scene: loaded once for all that differ in nothing that could change a mesh.
class SharedShapes {
 public:
  /// `cache_folder`: for tetrahedra, as for load_shapes.
  explicit SharedShapes(std::filesystem::path cache_folder) : cache_folder_(std::move(cache_folder)) {}

  /// Stays valid as long as this. Throws UserError as load_shapes does.
  const Shapes& of(const assets::Scene& scene);

 private:
  std::filesystem::path cache_folder_;
  std::map<std::string, std::unique_ptr<Shapes>> by_keys_;
};

}  // namespace softreel::app
