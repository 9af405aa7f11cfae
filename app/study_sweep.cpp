#include "app/study_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "assets/error.h"
#include "assets/scene_canonical.h"
#include "assets/scene_reader.h"
#include "sim/catalogue.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;

struct Axis {
  std::string option;  // for messages: "--substeps"
  std::string key;     // empty: a resolution
  std::vector<std::string> values;
};

constexpr const char* kSubsteps = "time.substeps";
constexpr const char* kIntegrator = "time.integrator";

// Ends of keys beside time., solver. and contact. that say how something is computed.
constexpr std::array<std::string_view, 6> kHow = {".cells",      ".links",         ".mass",
                                                  ".max_volume", ".bending_model", ".quality"};

bool says_how(const std::string& key) {
  if (key == "time.fps" || key == "time.duration") return false;
  const auto begins = [&](const char* part) { return key.starts_with(part); };
  return begins("time.") || begins("solver.") || begins("contact.") ||
         std::any_of(kHow.begin(), kHow.end(), [&](std::string_view end) { return key.ends_with(end); });
}

/// Reads a variant; mistakes are told of the option that made it.
assets::Scene read(const SweepRequest& request, const std::vector<std::string>& more, const std::string& option) {
  std::vector<std::string> overrides = request.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  try {
    return assets::read_scene(request.scene, overrides);
  } catch (const UserError& e) {
    std::vector<assets::Problem> problems = e.problems();
    for (assets::Problem& p : problems)
      for (const std::string& own : more)
        if (p.file == "--set " + own) p.file = option + " " + own;
    throw UserError(e.kind(), std::move(problems));
  }
}

double factor_of(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0) || value > 64)
    throw UserError(ErrorKind::kUsage,
                    fmt::format("--resolutions: found \"{}\", expected factors above 0 and at most 64: 0.5,1,2", text));
  return value;
}

std::vector<std::string> overrides_of(const assets::Scene& scene, const Axis& axis, const std::string& value) {
  if (axis.key.empty()) return resolution_overrides(scene, factor_of(value));
  return {axis.key + "=" + value};
}

std::string label_of(const Axis& axis, const std::string& value) {
  if (axis.key.empty()) return "resolution " + value;
  if (axis.key == kIntegrator || axis.key == "solver.linear") return value;
  if (axis.key == kSubsteps) return value + (value == "1" ? " substep" : " substeps");
  if (axis.key == "solver.tolerance") return "tolerance " + value;
  return axis.key + " = " + value;
}

/// Small scenes have the time for finer steps.
std::vector<std::string> default_substeps(const assets::Scene& scene) {
  long cells = 0;
  for (const auto& soft : scene.soft)
    cells += soft.block ? long(soft.block->cells[0]) * soft.block->cells[1] * soft.block->cells[2] : 2000;
  for (const auto& cloth : scene.cloth) cells += cloth.grid ? long(cloth.grid->cells[0]) * cloth.grid->cells[1] : 2000;
  if (cells < 200) return {"1", "2", "4", "8", "16", "32"};
  if (cells < 2000) return {"1", "2", "4", "8", "16"};
  return {"1", "2", "4", "8"};
}

std::vector<std::string> default_integrators(const assets::Scene& scene) {
  if (scene.time.integrator == "static") return {"static"};
  return {"implicit-euler", "bdf2", "newmark", "symplectic-euler", "verlet", "rk4"};
}

std::vector<std::string> default_tolerances(const assets::Scene& scene) {
  std::vector<std::string> list = {fmt::format("{:g}", scene.solver.tolerance)};
  if (scene.solver.tolerance > 1e-6) list.push_back("1e-6");
  return list;
}

std::vector<Axis> axes_of(const SweepRequest& request, const assets::Scene& scene) {
  std::vector<Axis> axes;
  const auto add = [&](const char* option, const char* key, const std::vector<std::string>& asked,
                       std::vector<std::string> otherwise) {
    std::vector<std::string> values = asked.empty() ? std::move(otherwise) : asked;
    if (!values.empty()) axes.push_back({asked.empty() ? "" : option, key, std::move(values)});
  };
  add("--integrators", kIntegrator, request.integrators, default_integrators(scene));
  add("--resolutions", "", request.resolutions, {});
  for (const std::string& sweep : request.sweeps) {
    const size_t equals = sweep.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UserError(ErrorKind::kUsage,
                      fmt::format("--sweep {}: expected key=v1,v2, such as solver.omega=1,1.5", sweep));
    axes.push_back({"--sweep", sweep.substr(0, equals), split_values(sweep.substr(equals + 1))});
  }
  add("--linear", "solver.linear", request.linear, {});
  add("--tolerances", "solver.tolerance", request.tolerances, default_tolerances(scene));
  add("--substeps", kSubsteps, request.substeps, default_substeps(scene));
  return axes;
}

/// Each value has to be possible by itself: what cannot be is a mistake of the command line, or no part of the default.
void check_axes(const SweepRequest& request, const assets::Scene& scene, std::vector<Axis>& axes) {
  for (Axis& axis : axes) {
    if (axis.key.empty() && resolution_overrides(scene, 1).empty())
      throw UserError(ErrorKind::kUsage,
                      "--resolutions: the scene has no grid, block or chain, and no mesh with "
                      "tetrahedralize.max_volume, whose cells could be changed");
    std::vector<std::string> possible;
    for (const std::string& value : axis.values) {
      try {
        read(request, overrides_of(scene, axis, value), axis.option);
        possible.push_back(value);
      } catch (const UserError&) {
        if (!axis.option.empty()) throw;
      }
    }
    if (!axis.key.empty() && !says_how(axis.key))
      throw UserError(
          ErrorKind::kUsage,
          fmt::format("--sweep {}: this key changes what is simulated, not how: errors against one reference "
                      "would mean nothing. Keys of time (without fps and duration), solver and contact, "
                      "and cells, links, mass, max_volume of bodies can be swept",
                      axis.key));
    axis.values = std::move(possible);
  }
  std::erase_if(axes, [](const Axis& axis) { return axis.values.empty(); });
}

/// Solver settings mean nothing to an explicit method.
bool has_effect(const Axis& axis, const std::string& integrator) {
  return !axis.key.starts_with("solver.") || sim::is_implicit(integrator);
}

StudyVariant make_variant(const SweepRequest& request, const assets::Scene& scene, const std::vector<Axis>& axes,
                          const std::vector<size_t>& index) {
  StudyVariant v;
  std::string integrator = scene.time.integrator;
  for (size_t a = 0; a < axes.size(); ++a)
    if (axes[a].key == kIntegrator) integrator = axes[a].values[index[a]];
  std::vector<std::string> overrides;
  std::string substeps;
  for (size_t a = 0; a < axes.size(); ++a) {
    const Axis& axis = axes[a];
    const std::string& value = axis.values[index[a]];
    if (!has_effect(axis, integrator)) continue;
    const std::vector<std::string> own = overrides_of(scene, axis, value);
    overrides.insert(overrides.end(), own.begin(), own.end());
    for (const std::string& o : own) v.settings.emplace_back(o.substr(0, o.find('=')), o.substr(o.find('=') + 1));
    if (axis.key == kSubsteps)
      substeps = label_of(axis, value);
    else
      v.method += (v.method.empty() ? "" : ", ") + label_of(axis, value);
  }
  v.label = v.method + (substeps.empty() ? "" : ", " + substeps);
  v.scene = scene;
  try {
    v.scene = read(request, overrides, "settings");
  } catch (const UserError& e) {
    v.refusal = e.problems().front().message;
    v.scene.time.integrator = integrator;
  }
  return v;
}

}  // namespace

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    if (c == ',' && depth == 0)
      values.emplace_back();
    else if (c != ' ' || !values.back().empty())
      values.back() += c;
  }
  return values;
}

std::vector<std::string> resolution_overrides(const assets::Scene& scene, double factor) {
  std::vector<std::string> overrides;
  const auto scaled = [factor](int cells) { return std::max(1, static_cast<int>(std::lround(cells * factor))); };
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    const assets::SoftBody& soft = scene.soft[i];
    if (soft.block) {
      const auto& n = soft.block->cells;
      overrides.push_back(
          fmt::format("soft.{}.block.cells=[{}, {}, {}]", i + 1, scaled(n[0]), scaled(n[1]), scaled(n[2])));
    } else if (soft.tetrahedralize.max_volume) {
      overrides.push_back(fmt::format("soft.{}.tetrahedralize.max_volume={:.17g}", i + 1,
                                      *soft.tetrahedralize.max_volume / (factor * factor * factor)));
    }
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i)
    if (const auto& grid = scene.cloth[i].grid)
      overrides.push_back(
          fmt::format("cloth.{}.grid.cells=[{}, {}]", i + 1, scaled(grid->cells[0]), scaled(grid->cells[1])));
  for (size_t i = 0; i < scene.springs.size(); ++i)
    if (const auto& chain = scene.springs[i].chain)
      overrides.push_back(fmt::format("springs.{}.chain.links={}", i + 1, scaled(chain->links)));
  return overrides;
}

Sweep plan_sweep(const SweepRequest& request) {
  Sweep sweep;
  sweep.scene = assets::read_scene(request.scene, request.overrides);
  assets::check_assets(sweep.scene);
  std::vector<Axis> axes = axes_of(request, sweep.scene);
  check_axes(request, sweep.scene, axes);
  std::map<std::string, size_t> known;  // physics -> variant
  const auto add = [&](StudyVariant variant) {
    const std::string physics = variant.refusal.empty() ? assets::canonical_physics(variant.scene) : variant.label;
    if (!known.emplace(physics, sweep.variants.size()).second) return;
    sweep.most_substeps = std::max(sweep.most_substeps, variant.scene.time.substeps);
    sweep.variants.push_back(std::move(variant));
  };
  std::vector<size_t> index(axes.size(), 0);
  for (bool more = true; more;) {
    add(make_variant(request, sweep.scene, axes, index));
    more = false;
    for (size_t a = axes.size(); a-- > 0 && !more;) {  // the last one runs fastest
      more = ++index[a] < axes[a].values.size();
      if (!more) index[a] = 0;
    }
  }
  const auto now = known.find(assets::canonical_physics(sweep.scene));
  if (now != known.end()) {
    sweep.variants[now->second].present = true;
  } else {
    StudyVariant as_it_is;
    as_it_is.scene = sweep.scene;
    as_it_is.method = "as it is: " + sweep.scene.time.integrator;
    as_it_is.label = fmt::format("{}, {} substeps", as_it_is.method, sweep.scene.time.substeps);
    as_it_is.present = true;
    add(std::move(as_it_is));
  }
  for (const std::string& factor : request.resolutions) sweep.finest = std::max(sweep.finest, factor_of(factor));
  return sweep;
}

}  // namespace softreel::app
