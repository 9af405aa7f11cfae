// softreel study --stability SCENE
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "app/progress.h"
#include "app/stability_map.h"
#include "app/stability_plot.h"
#include "assets/atomic_file.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;

std::string quoted(std::string text) {  // RFC 4180
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string csv_of(const StabilityMap& map) {
  std::string csv = quoted(map.x.key) + "," + quoted(map.y.key) + ",outcome,energy_change,step_over_limit,why\n";
  for (size_t r = 0; r < map.y.values.size(); ++r)
    for (size_t c = 0; c < map.x.values.size(); ++c) {
      const MapCell& cell = map.at(c, r);
      csv += fmt::format("{},{},{},{:.6g},{:.6g},{}\n", quoted(map.x.values[c]), quoted(map.y.values[r]),
                         outcome_name(cell.outcome), cell.energy_change, cell.step_over_limit, quoted(cell.why));
    }
  return csv;
}

std::string json_of(const StudyArguments& a, const StabilityMap& map, const MapScore& score) {
  nlohmann::ordered_json j;
  j["scene"] = a.scene;
  j["command"] = a.command;
  j["x"] = {{"key", map.x.key}, {"values", map.x.values}};
  j["y"] = {{"key", map.y.key}, {"values", map.y.values}};
  j["forecast"] = {{"right", score.right}, {"judged", score.judged}};
  j["cells"] = nlohmann::ordered_json::array();
  for (size_t r = 0; r < map.y.values.size(); ++r)
    for (size_t c = 0; c < map.x.values.size(); ++c) {
      const MapCell& cell = map.at(c, r);
      nlohmann::ordered_json entry = {{"x", map.x.values[c]},
                                      {"y", map.y.values[r]},
                                      {"outcome", outcome_name(cell.outcome)},
                                      {"energy_change", cell.energy_change},
                                      {"step_over_limit", cell.step_over_limit}};
      if (!cell.why.empty()) entry["why"] = cell.why;
      j["cells"].push_back(std::move(entry));
    }
  return j.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::pair<int, int> parse_cells(const std::string& text) {
  int across = 0, up = 0, end = 0;
  if (std::sscanf(text.c_str(), "%6dx%6d%n", &across, &up, &end) != 2 || static_cast<size_t>(end) != text.size() ||
      across < 1 || up < 1 || static_cast<double>(across) * up > 1e6)
    throw assets::UserError(assets::ErrorKind::kUsage,
                            fmt::format("--cells: found \"{}\", expected two numbers, such as 20x20", text));
  return {across, up};
}

}  // namespace

int run_stability_map(const StudyArguments& a, double seconds) {
  const auto [across, up] = parse_cells(a.cells);
  if (a.x.empty() || a.y.empty())
    throw assets::UserError(assets::ErrorKind::kUsage,
                            "--stability needs --x and --y, such as --x time.substeps=1..64 --y "
                            "time.integrator=verlet,rk4");
  const MapAxis x = parse_axis("--x", a.x, across), y = parse_axis("--y", a.y, up);
  const fs::path output =
      a.output.empty() ? fs::path("out") / (fs::path(a.scene).stem().string() + "-stability") : fs::path(a.output);
  check_output_folder(output);
  const MapRequest request{a.scene, a.overrides, x, y, seconds, output / "cache" / "cells"};
  SharedShapes shapes(output / "cache");
  StabilityMap map;
  {
    Progress progress("stability", static_cast<int>(request.x.values.size() * request.y.values.size()), a.quiet,
                      "cells");
    map = measure_map(request, shapes, [&] { progress.advance(); });
  }
  if (map.kept > 0) say(a.quiet, fmt::format("{} cells were measured before", map.kept));
  const MapScore score = score_of(map);
  assets::write_file_atomically(output / "stability.csv", csv_of(map));
  assets::write_file_atomically(output / "stability.json", json_of(a, map, score));
  const bool drawn = draw_plot(stability_plot(fs::path(a.scene).stem().string(), map), output);
  for (const Outcome outcome : {Outcome::kHeld, Outcome::kDampedAway, Outcome::kDrifted, Outcome::kBlewUp,
                                Outcome::kNotConverged, Outcome::kRefused, Outcome::kNotRun}) {
    const auto n =
        std::count_if(map.cells.begin(), map.cells.end(), [&](const MapCell& cell) { return cell.outcome == outcome; });
    if (n > 0) fmt::print("{:<18}{} cells\n", outcome_name(outcome), n);
  }
  if (score.judged > 0)
    fmt::print("forecast right in {} of {} cells (those within {:.0f} % of the limit left out)\n", score.right,
               score.judged, 100 * kUndecided);
  if (!drawn) say(a.quiet, "note: gnuplot is not installed, so there is no picture");
  fmt::print("{}\n", (output / (drawn ? "stability.svg" : "stability.csv")).string());
  return kDone;
}

int run_stability_regions(const StudyArguments& a) {
  const fs::path output = a.output.empty() ? fs::path("out") / "regions" : fs::path(a.output);
  check_output_folder(output);
  if (!draw_plot(regions_plot(), output))
    throw assets::UserError(assets::ErrorKind::kInput, "--regions needs gnuplot, which is not installed");
  fmt::print("{}\n", (output / "regions.svg").string());
  return kDone;
}

}  // namespace softreel::app
