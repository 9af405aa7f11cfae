#include "app/feature_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/external_program.h"
#include "app/features.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "assets/atomic_file.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

constexpr const char* kCells = "40";  // along a side of sheets: large enough for a step to outweigh the clock

struct Sample {
  double milliseconds = 0, memory = 0;
};

const Feature* named(std::string_view name) {
  for (const Feature& f : features())
    if (f.name == name) return &f;
  return nullptr;
}

std::string_view unit_of(const Feature& f) {
  if (f.whole_run) return "run";
  return f.drawn ? "frame" : "step";
}

bool explicit_against_implicit(const Feature& f) {
  return std::any_of(f.overrides.begin(), f.overrides.end(),
                     [](std::string_view key) { return key.starts_with("time.integrator="); });
}

/// Arguments of a run of `of` (null: the base scene), as `row` is measured.
std::vector<std::string> arguments_of(const Feature* of, const Feature& row, const std::filesystem::path& folder) {
  std::vector<std::string> arguments = feature_arguments(of, write_feature_scene(of, folder));
  arguments[0] = row.drawn ? "render" : "simulate";
  const auto set = [&](std::string key) { arguments.insert(arguments.begin() + 2, {"--set", std::move(key)}); };
  const auto has = [&](std::string_view part) { return of && of->scene.find(part) != std::string_view::npos; };
  // What the feature itself overrides comes later and counts.
  set(fmt::format("cloth.sheet.grid.cells=[{0},{0}]", kCells));
  if (has("name = \"below\"")) set(fmt::format("cloth.below.grid.cells=[{0},{0}]", kCells));
  if (has("name = \"net\"")) set(fmt::format("cloth.net.grid.cells=[{0},{0}]", kCells));
  if (has("[[field]]")) set(fmt::format("field.1.grid.cells=[{0},{0}]", kCells));
  if (has("block =")) set("soft.block.block.cells=[8,8,8]");
  if (explicit_against_implicit(row) || row.checked)
    set("time.substeps=20");  // what holds explicitly at this size
  else
    set("time.integrator=\"implicit-euler\"");
  set("time.duration=0.5");
  if (row.drawn) set("render.size=[640,360]");
  return arguments;
}

Sample run_once(std::vector<std::string> arguments, std::string_view unit, const std::filesystem::path& folder,
                int threads) {
  // Everything anew each time.
  std::filesystem::remove_all(folder / "out");
  const std::filesystem::path stats = folder / "figures.json";
  arguments.insert(arguments.begin(), std::filesystem::read_symlink("/proc/self/exe").string());
  for (const std::string& more : {std::string("--quiet"), std::string("-o"), (folder / "out").string()})
    arguments.push_back(more);
  if (threads > 0) arguments.insert(arguments.end(), {"--threads", std::to_string(threads)});
  arguments.insert(arguments.end(), {"--stats", stats.string()});
  PipeTo program(arguments, stop_if_interrupted);
  if (program.finish() != 0)
    throw assets::UserError(assets::ErrorKind::kSimulation,
                            fmt::format("bench: {} failed: {}", fmt::join(arguments, " "), program.complaint()));
  const auto j = nlohmann::json::parse(assets::read_file(stats));
  const nlohmann::json& seconds = j.at("seconds");
  Sample sample;
  sample.memory = j.at("peak_memory_bytes").get<double>() / 1048576;
  if (unit == "step")
    sample.milliseconds = 1e3 * seconds.at("simulate").get<double>() / j.at("steps").get<double>();
  else if (unit == "frame")
    sample.milliseconds = 1e3 * seconds.at("render").get<double>() / j.at("frames_rendered").get<double>();
  else
    sample.milliseconds = 1e3 * seconds.at("total").get<double>();
  return sample;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// --stats is how the others are measured.
bool is_the_measure(const Feature& f) { return !f.options.empty() && f.options.front() == "--stats"; }

/// Rows that run the same scene tell the same.
bool seen_before(const Feature& f) {
  for (const Feature& earlier : features()) {
    if (&earlier == &f) return false;
    if (!earlier.scene.empty() || !earlier.overrides.empty())
      if (earlier.scene == f.scene && earlier.overrides == f.overrides && earlier.options == f.options) return true;
  }
  return false;
}

}  // namespace

std::vector<FeatureCost> measure_features(const std::filesystem::path& folder, int repeats, int threads, bool quiet) {
  std::vector<const Feature*> rows;
  for (const Feature& f : features())
    if (f.without.empty() && !f.in_base() && !is_the_measure(f) && !seen_before(f)) rows.push_back(&f);
  std::vector<FeatureCost> costs;
  Progress progress("bench", static_cast<int>(rows.size()), quiet);
  for (const Feature* f : rows) {
    const Feature* against = named(f->against);
    const std::string_view unit = unit_of(*f);
    const auto a = arguments_of(against, *f, folder / "without"), b = arguments_of(f, *f, folder / "with");
    std::vector<double> times[2], memory[2];
    try {
      for (int k = -1; k < repeats; ++k)  // the first time is for caches of files and shaders
        for (const bool with : {false, true}) {
          const Sample s = run_once(with ? b : a, unit, folder / (with ? "with" : "without"), threads);
          if (k >= 0) times[with].push_back(s.milliseconds), memory[with].push_back(s.memory);
        }
    } catch (const assets::UserError& e) {  // one that cannot run at this size is told, and left out of the table
      say(quiet, fmt::format("{} is left out: {}", f->name, e.what()));
      progress.advance();
      continue;
    }
    costs.push_back({std::string(f->name), against ? std::string(against->name) : "the base scene", std::string(unit),
                     median(times[0]), median(times[1]), median(memory[0]), median(memory[1])});
    progress.advance();
  }
  return costs;
}

std::string feature_table(const std::vector<FeatureCost>& costs) {
  std::string text =
      "| feature | against | ms a | without | with | costs | memory [MiB] |\n|---|---|---|---|---|---|---|\n";
  for (const FeatureCost& c : costs)
    text += fmt::format("| {} | {} | {} | {:.3g} | {:.3g} | {:+.3g} | {:+.1f} |\n", c.feature, c.against, c.per,
                        c.without, c.with, c.with - c.without, c.memory_with - c.memory_without);
  return text;
}

}  // namespace softreel::app
