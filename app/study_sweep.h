#pragma once
// The settings that a study compares: one variant of the scene for each.
#include <string>
#include <utility>
#include <vector>

#include "assets/scene.h"

namespace softreel::app {

/// What the command line asks for; empty lists: what suits the scene.
struct SweepRequest {
  std::string scene;                   ///< file
  std::vector<std::string> overrides;  ///< key=value, for all variants
  std::vector<std::string> integrators, substeps, tolerances, linear;
  std::vector<std::string> resolutions;  ///< factors on the cells of grids, blocks and chains
  std::vector<std::string> sweeps;       ///< key=v1,v2
};

struct StudyVariant {
  assets::Scene scene;
  std::vector<std::pair<std::string, std::string>> settings;  ///< what differs from the scene file: key, value
  std::string method;    ///< all but the number of substeps: one line of a plot. "bdf2, tolerance 1e-6"
  std::string label;     ///< method and substeps, for the user
  bool present = false;  ///< what the scene uses now
  std::string refusal;   ///< why these settings do not go together; empty: they do
};

struct Sweep {
  assets::Scene scene;                 ///< as it is, with the overrides for all
  std::vector<StudyVariant> variants;  ///< each of other physics; one of them is what the scene uses now
  double finest = 1;                   ///< largest factor of resolution
  int most_substeps = 1;
};

/// Throws UserError (kUsage) for keys and values that cannot be, and for keys that change what is simulated instead of
/// how it is; (kInput) as read_scene does.
Sweep plan_sweep(const SweepRequest& request);

/// Overrides that multiply the cells of grids, blocks and chains by `factor`, and the tetrahedra of filled surfaces by
/// its cube. Empty when the scene has none of them.
std::vector<std::string> resolution_overrides(const assets::Scene& scene, double factor);

/// "a,[1, 2],c" taken apart at the commas that are in no brackets.
std::vector<std::string> split_values(const std::string& text);

}  // namespace softreel::app
