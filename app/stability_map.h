#pragma once
// Which settings hold: a scene run at every point of a grid over two of its keys, beside what the forecast says.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/arguments.h"
#include "app/stability_outcome.h"
#include "app/trial.h"
#include "assets/scene.h"

namespace softreel::app {

/// A key of the scene and the values that it takes.
struct MapAxis {
  std::string key;
  std::vector<std::string> values;  ///< as --set takes them
  bool numeric = false;             ///< all are numbers: drawn to scale, logarithmic if all are above 0
};

/// `text`: "KEY=A..B" (numbers in equal ratios if both are above 0, else in equal steps; whole ones where both ends are
/// written as such, each once) or "KEY=a,b,c". `option`: for messages. Throws UserError (kUsage).
MapAxis parse_axis(const std::string& option, const std::string& text, int cells);

struct MapCell {
  Outcome outcome = Outcome::kNotRun;
  double energy_change = 0;    ///< of energy_change()
  double step_over_limit = 0;  ///< what was forecast: h over the largest step that holds; 0: there is no limit
  std::string why;             ///< of failures
  bool forecast_holds() const { return step_over_limit <= 1; }
  bool held() const { return outcome != Outcome::kBlewUp && outcome != Outcome::kNotConverged; }
};

struct StabilityMap {
  MapAxis x, y;
  int kept = 0;                ///< cells that were measured before
  std::vector<MapCell> cells;  ///< rows of y, each along x

  const MapCell& at(size_t column, size_t row) const { return cells[row * x.values.size() + column]; }
};

/// How often the forecast was right, of the cells that were run and are farther than kUndecided from their limit.
struct MapScore {
  int right = 0, judged = 0;
};
inline constexpr double kUndecided = 0.05;
MapScore score_of(const StabilityMap& map);

struct MapRequest {
  std::string scene;
  std::vector<std::string> overrides;
  MapAxis x, y;
  double seconds = 0;  ///< for all of it; what is left then is not run
  /// Where measured cells are kept, and looked for before they are measured; empty: nowhere.
  std::filesystem::path store;
};

/// Runs them all; a cell that cannot be read or built is refused, not an error, unless all are. `done` is called after
/// each. Throws UserError (kUsage); Interrupted.
StabilityMap measure_map(const MapRequest& request, SharedShapes& shapes, const std::function<void()>& done);

/// `softreel study --stability SCENE`: writes stability.csv, .json, .svg and .png. `seconds`: of --budget.
int run_stability_map(const StudyArguments& arguments, double seconds);

/// `softreel study --regions`: writes regions.svg and .png.
int run_stability_regions(const StudyArguments& arguments);

}  // namespace softreel::app
