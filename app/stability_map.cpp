#include "app/stability_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>

#include "app/forecast.h"
#include "app/map_store.h"
#include "app/world.h"
#include "assets/error.h"
#include "assets/scene_reader.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;
using Clock = std::chrono::steady_clock;

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || at != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool whole(std::string_view text) { return text.find_first_not_of("0123456789") == std::string_view::npos; }

std::vector<std::string> range(std::string_view from, std::string_view to, double a, double b, int cells) {
  std::vector<std::string> values;
  const bool ratios = a > 0 && b > 0, integers = whole(from) && whole(to);
  for (int k = 0; k < cells; ++k) {
    const double u = cells > 1 ? static_cast<double>(k) / (cells - 1) : 0;
    const double value = ratios ? a * std::pow(b / a, u) : a + u * (b - a);
    std::string text = integers ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value);
    if (values.empty() || values.back() != text) values.push_back(std::move(text));
  }
  return values;
}

/// Keeps nothing of a frame but what energies and the end need: thousands of cells would fill the memory.
MapCell measure_cell(const assets::Scene& scene, const Shapes& shapes, double seconds) {
  MapCell cell;
  try {
    const sim::Model model = build_model(scene, shapes);
    if (model.vertices() > 0 && has_step_limit(scene)) {
      const double limit = forecast_step(scene, model).largest_step();
      cell.step_over_limit = std::isfinite(limit) ? scene.time.step() / limit : 0;
    }
  } catch (const UserError& e) {
    return {Outcome::kRefused, 0, 0, e.problems().front().message};
  }
  TrialOptions options;
  options.seconds = seconds;
  const Trial trial = run_trial(scene, shapes, options);
  cell.outcome = outcome_of(scene, trial);
  if (!trial.failure) cell.energy_change = energy_change(trial);
  if (trial.failure) cell.why = trial.failure->why;
  return cell;
}

}  // namespace

MapAxis parse_axis(const std::string& option, const std::string& text, int cells) {
  const auto refuse = [&] {
    throw UserError(ErrorKind::kUsage,
                    fmt::format("{}: found \"{}\", expected KEY=A..B with two numbers, or KEY=A,B,..., such as "
                                "soft.block.material.young=1e2..1e9 or time.integrator=verlet,rk4",
                                option, text));
  };
  const size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0 || equal + 1 == text.size()) refuse();
  MapAxis axis;
  axis.key = text.substr(0, equal);
  const std::string_view values = std::string_view(text).substr(equal + 1);
  const size_t dots = values.find("..");
  if (dots != std::string_view::npos) {
    const std::string_view from = values.substr(0, dots), to = values.substr(dots + 2);
    const std::optional<double> a = number(from), b = number(to);
    if (!a || !b || !(*a < *b)) refuse();
    axis.values = range(from, to, *a, *b, cells);
    axis.numeric = true;
    return axis;
  }
  axis.numeric = true;
  for (size_t at = 0; at <= values.size();) {
    const size_t comma = std::min(values.find(',', at), values.size());
    if (comma == at) refuse();
    axis.values.emplace_back(values.substr(at, comma - at));
    axis.numeric = axis.numeric && number(axis.values.back());
    at = comma + 1;
  }
  return axis;
}

MapScore score_of(const StabilityMap& map) {
  MapScore score;
  for (const MapCell& cell : map.cells) {
    if (cell.outcome == Outcome::kNotRun || cell.outcome == Outcome::kRefused) continue;
    if (std::abs(cell.step_over_limit - 1) < kUndecided) continue;
    ++score.judged;
    score.right += cell.held() == cell.forecast_holds() ? 1 : 0;
  }
  return score;
}

StabilityMap measure_map(const MapRequest& request, SharedShapes& shapes, const std::function<void()>& done) {
  const Clock::time_point start = Clock::now();
  StabilityMap map{request.x, request.y, 0, {}};
  const MapStore store(request.store);
  std::optional<UserError> refusal;
  bool any = false;
  for (const std::string& y : map.y.values)
    for (const std::string& x : map.x.values) {
      std::vector<std::string> overrides = request.overrides;
      overrides.push_back(map.x.key + "=" + x);
      overrides.push_back(map.y.key + "=" + y);
      const double left = request.seconds - std::chrono::duration<double>(Clock::now() - start).count();
      MapCell cell;
      try {
        const assets::Scene scene = assets::read_scene(request.scene, overrides);
        const std::string hash = request.store.empty() ? "" : MapStore::hash_of(scene);
        const std::optional<MapCell> kept = hash.empty() ? std::nullopt : store.read(hash);
        if (kept)
          cell = *kept;
        else if (left > 0)
          cell = measure_cell(scene, shapes.of(scene), left);
        map.kept += kept ? 1 : 0;
        const bool measured = std::find(kMeasured.begin(), kMeasured.end(), cell.outcome) != kMeasured.end();
        if (!hash.empty() && !kept && measured) store.write(hash, cell);
        any = true;
      } catch (const UserError& e) {
        cell = {Outcome::kRefused, 0, 0, e.problems().front().message};
        if (!refusal) refusal = e;
      }
      map.cells.push_back(std::move(cell));
      done();
    }
  if (!any && refusal) throw *refusal;  // a key that does not exist, most often
  return map;
}

}  // namespace softreel::app
