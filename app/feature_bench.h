#pragma once
// What a feature costs where it is used (softreel bench --features).
#include <filesystem>
#include <string>
#include <vector>

namespace softreel::app {

/// A row: the scene with a feature against the same scene without it. Medians over runs that took turns.
struct FeatureCost {
  std::string feature, against;                ///< against: the scene without it
  std::string per;                             ///< what is measured: "step", "frame" or "run"
  double without = 0, with = 0;                ///< [ms]
  double memory_without = 0, memory_with = 0;  ///< largest of a run [MiB]
};

/// Runs this program `repeats` times on both scenes of each feature, in turns, each in a process of its own, with
/// `threads` threads; scenes and outputs in `folder`. Throws UserError if a run fails, Interrupted.
std::vector<FeatureCost> measure_features(const std::filesystem::path& folder, int repeats, int threads, bool quiet);

/// As a table of Markdown.
std::string feature_table(const std::vector<FeatureCost>& costs);

}  // namespace softreel::app
