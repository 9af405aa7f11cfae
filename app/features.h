#pragma once
// What a scene or a command may ask for beyond the least: one table for all that measures it (softreel bench
// --features, tests/needs).
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace softreel::app {

/// One optional feature: how a scene asks for it, and where its code is.
struct Feature {
  std::string_view name;  ///< as in the bill, where the bill has a line for it
  /// Code that runs for this feature alone: source files from the root without ending (sim/wind, app/stats), or the
  /// beginning of a function's full name (softreel::sim::Motion::).
  std::vector<std::string_view> code;
  std::vector<std::string_view> brings{};       ///< other features that it is never without
  std::vector<std::string_view> shares_code{};  ///< features that a scene with it need not use, but code of which runs
  std::string_view against{};                   ///< whose scene shows what it costs; empty: the base scene
  std::vector<std::string_view> overrides{};    ///< of the base scene, as --set
  std::string_view scene{};                     ///< TOML that follows the base scene
  std::vector<std::string_view> options{};      ///< of the command line; @ at the front: beside the scene
  std::vector<std::pair<std::string_view, std::string_view>> files{};  ///< beside the scene: name, content
  std::vector<std::string_view> without{};                             ///< features of the base scene that it replaces
  std::vector<std::string_view> stats{};  ///< keys of --stats that are there only with it (energy.contact)
  bool drawn = false;                     ///< seen by `render`, not by `simulate`
  bool checked = false;                   ///< the run is not forced: its stability is looked at before it begins
  bool whole_run = false;                 ///< its cost is one of a run, not of a step or a frame

  bool in_base() const { return scene.empty() && overrides.empty() && options.empty() && !checked; }
};

/// A sheet in free fall, stepped explicitly, drawn with one sample and no shadow.
extern const std::string_view kBaseScene;
/// Features that the base scene cannot do without.
extern const std::vector<std::string_view> kBaseFeatures;

std::span<const Feature> features();

/// Puts the scene of a feature (null: the base scene) and its files into `folder`; returns the scene file.
std::filesystem::path write_feature_scene(const Feature* feature, const std::filesystem::path& folder);

/// Arguments of a run of it: COMMAND SCENE --set ... and options.
std::vector<std::string> feature_arguments(const Feature* feature, const std::filesystem::path& scene);

}  // namespace softreel::app
