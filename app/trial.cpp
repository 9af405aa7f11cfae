#include "app/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string_view>

#include "app/interrupt.h"
#include "assets/error.h"
#include "assets/scene_canonical.h"

namespace softreel::app {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The peak that /proc shows goes back to the present size (proc(5), clear_refs); without that it would be the peak of
/// every trial before.
void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

long peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stol(line.substr(6));
  return 0;
}

/// What a comparison needs of a frame: not what a simulation needs to go on from it.
CachedFrame frame_of(const ClipWorld& world, const sim::StepReport& sum) {
  CachedFrame frame = world.frame(sum);
  frame.memory.clear();
  for (CachedField& field : frame.fields) field.memory.clear();
  return frame;
}

bool finite(const CachedFrame& frame) {
  return frame.state.x.allFinite() && std::all_of(frame.fields.begin(), frame.fields.end(),
                                                  [](const CachedField& f) { return f.value.allFinite(); });
}

/// Steps from frame to frame; returns why it ended early.
std::optional<TrialFailure> run_frames(const assets::Scene& scene, ClipWorld& world, const TrialOptions& options,
                                       Clock::time_point start, Trial& trial) {
  const int last = options.last_frame > 0 ? std::min(options.last_frame, scene.time.frames()) : scene.time.frames();
  const double h = scene.time.step();
  long step = 0;
  for (int frame = 2; frame <= last; ++frame) {
    sim::StepReport sum;
    for (int k = 0; k < scene.time.substeps; ++k) {
      stop_if_interrupted();
      const double t = static_cast<double>(step) * h;
      if (since(start) > options.seconds)
        return TrialFailure{TrialEnd::kBudget, frame, t, step, fmt::format("not done after {:.3g} s", options.seconds)};
      ++step;
      const Clock::time_point wall = Clock::now();
      const double processor = processor_seconds();
      const std::optional<StepFailure> failure = world.step(h, sum);
      trial.wall_seconds += since(wall);
      trial.processor_seconds += processor_seconds() - processor;
      if (failure) {
        trial.total.add(sum);
        return TrialFailure{TrialEnd::kFailed, frame, t, step, failure->why};
      }
    }
    trial.total.add(sum);
    trial.frames.push_back(frame_of(world, sum));
    const double t = static_cast<double>(step) * h;
    if (!finite(trial.frames.back())) return TrialFailure{TrialEnd::kFailed, frame, t, step, "values are not finite"};
    if (options.stop)
      if (std::string why = options.stop(world, frame); !why.empty())
        return TrialFailure{TrialEnd::kStopped, frame, t, step, std::move(why)};
  }
  return std::nullopt;
}

// Keys that change no mesh: whole sections, and what bodies have beside their shape.
constexpr std::array<std::string_view, 8> kSections = {"gravity", "time.", "solver.",  "load.",
                                                       "attach.", "wind.", "contact.", "damping."};
constexpr std::array<std::string_view, 11> kBodyKeys = {".material.",  ".density ",     ".velocity ", ".spin ",
                                                        ".pins.",      ".source ",      ".initial",   ".springs.",
                                                        ".stiffness ", ".diffusivity ", ".speed "};

bool changes_no_mesh(std::string_view line) {
  return std::any_of(kSections.begin(), kSections.end(), [&](std::string_view s) { return line.starts_with(s); }) ||
         std::any_of(kBodyKeys.begin(), kBodyKeys.end(),
                     [&](std::string_view s) { return line.find(s) < line.find('='); });
}

}  // namespace

Trial run_trial(const assets::Scene& scene, const Shapes& shapes, const TrialOptions& options) {
  const Clock::time_point start = Clock::now();
  Trial trial;
  forget_peak_memory();
  try {
    ClipWorld world(scene, shapes);
    trial.setup_seconds = since(start);
    trial.frames.push_back(frame_of(world, {}));
    trial.failure = run_frames(scene, world, options, start, trial);
  } catch (const assets::UserError& e) {
    trial.failure = TrialFailure{TrialEnd::kRefused, 1, 0, 0, e.problems().front().message};
  }
  trial.peak_memory_bytes = peak_memory();
  return trial;
}

const Shapes& SharedShapes::of(const assets::Scene& scene) {
  std::string keys;
  std::istringstream lines(assets::canonical_physics(scene));
  for (std::string line; std::getline(lines, line);)
    if (!changes_no_mesh(line)) keys += line + '\n';
  std::unique_ptr<Shapes>& shapes = by_keys_[keys];
  if (!shapes) shapes = std::make_unique<Shapes>(load_shapes(scene, cache_folder_));
  return *shapes;
}

}  // namespace softreel::app
