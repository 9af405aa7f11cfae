// softreel study SCENE
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "app/progress.h"
#include "app/stability_map.h"
#include "app/stage.h"
#include "app/study_apply.h"
#include "app/study_plot.h"
#include "app/study_render.h"
#include "app/study_report.h"
#include "app/study_run.h"
#include "app/study_summary.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "render/error.h"
#include "render/png.h"
#include "sim/parallel.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;
using Clock = std::chrono::steady_clock;

constexpr double kReferencePart = 0.5;  // of the budget, at most

double parse_budget(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  const std::string unit(at, end);
  const double scale = unit == "s" || unit.empty() ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (error != std::errc() || !(value * scale > 0) || !(value * scale < 1e9))
    throw UserError(ErrorKind::kUsage,
                    fmt::format("--budget: found \"{}\", expected a time above 0, such as 60s, 5m or 1h", text));
  return value * scale;
}

/// Where --apply writes, found out before anything is run.
std::filesystem::path apply_file(const StudyArguments& a) {
  const std::filesystem::path scene = a.scene;
  std::filesystem::path file = a.apply_to;
  if (file.empty()) file = scene.parent_path() / (scene.stem().string() + "-studied.toml");
  std::error_code ignored;
  if (std::filesystem::equivalent(file, scene, ignored) && !a.overwrite)
    throw UserError(ErrorKind::kUsage, "--apply-to: is the scene itself; --overwrite allows that");
  if (std::filesystem::weakly_canonical(file.parent_path().empty() ? "." : file.parent_path(), ignored) !=
      std::filesystem::weakly_canonical(scene.parent_path().empty() ? "." : scene.parent_path(), ignored))
    throw UserError(ErrorKind::kUsage,
                    "--apply-to: has to be in the folder of the scene, whose paths are relative to it");
  check_output_file(file);
  return file;
}

StudyView view_of(const Sweep& sweep, const StudyReference& reference, SharedShapes& shapes) {
  ClipExtent extent;
  for (const CachedFrame& frame : reference.frames)
    add_frame(reference.scene, shapes.of(reference.scene), frame, extent);
  return StudyView(sweep.scene, extent);
}

/// The last frames of the best and the worst run, small; nothing where they cannot be drawn.
std::vector<ReportPicture> pictures(const Sweep& sweep, const std::vector<StudyRow>& rows,
                                    const std::vector<std::string>& hashes, const StudyStore& store,
                                    const StudyReference& reference, SharedShapes& shapes) {
  std::vector<ReportPicture> result;
  ClipExtent extent;
  for (const CachedFrame& frame : reference.frames)
    add_frame(reference.scene, shapes.of(reference.scene), frame, extent);
  for (const auto& [row, what] : {std::pair{best_row(rows), "best"}, std::pair{worst_row(rows), "worst"}}) {
    if (!row) return result;
    const size_t i = static_cast<size_t>(row - rows.data());
    const auto frame = store.last_frame(hashes[i]);
    if (!frame) continue;
    assets::Scene scene = sweep.variants[i].scene;
    const auto [width, height] = scene.render.size;
    scene.render.size = {320, std::max(1, static_cast<int>(std::lround(320.0 * height / width)))};
    scene.render.samples = scene.render.samples == 0 ? 4 : std::min(scene.render.samples, 4);
    try {
      const std::vector<unsigned char> png =
          render::encode_png(Stage(scene, shapes.of(scene), extent).draw(1, *frame, nullptr));
      result.push_back({fmt::format("{}: {}, {:.2g} m off", what, row->label, row->errors->worst),
                        std::string(png.begin(), png.end())});
    } catch (const render::RenderError&) {
      return result;  // the study does not need them
    }
  }
  return result;
}

void apply(const std::filesystem::path& file, const StudyArguments& a, const std::vector<StudyRow>& rows, double size) {
  const StudyTarget target = parse_target(a.apply);
  const StudyRow* row = fastest(rows, target, size);
  if (!row)
    throw UserError(ErrorKind::kSimulation,
                    fmt::format("--apply {}: no run was within it; more substeps, other integrators or a larger budget "
                                "may be. The study is complete",
                                a.apply));
  std::vector<std::pair<std::string, std::string>> settings = row->settings;
  for (const std::string& o : a.overrides)  // what was studied is the scene with these
    settings.insert(settings.begin(), {o.substr(0, o.find('=')), o.substr(o.find('=') + 1)});
  assets::write_file_atomically(file, with_settings(assets::read_file(a.scene), a.scene, settings));
  say(a.quiet, fmt::format("{}: {}", file.string(), row->label));
}

std::string warning_of(const Sweep& sweep, const StudyReference& reference, const std::vector<StudyRow>& rows) {
  std::string warning;
  if (reference.floor > 0.01 * reference.size)
    warning = fmt::format(
        "No finer run agrees with itself to 1 % of the size (two of them are {:.2g} m apart): what the scene does "
        "depends on the smallest differences, and errors below that say nothing.",
        reference.floor);
  if (!sweep.scene.fields.empty()) warning += " Scalar fields are stepped along but not measured.";
  const auto out = std::count_if(rows.begin(), rows.end(),
                                 [](const StudyRow& r) { return r.failure && r.failure->end == TrialEnd::kBudget; });
  if (out > 0) warning += fmt::format(" {} of {} runs did not fit into the budget.", out, rows.size());
  return warning.empty() || warning[0] != ' ' ? warning : warning.substr(1);
}

/// Files of the study; returns that of the report.
std::filesystem::path write_study(const std::filesystem::path& output, StudyReport& report,
                                  const std::vector<StudyRow>& rows, const StudyReference& reference,
                                  const assets::Scene& scene, bool quiet) {
  assets::write_file_atomically(output / "study.csv", study_csv(rows, reference));
  assets::write_file_atomically(output / "study.json", study_json(report.head, rows, reference));
  const std::string title = scene.title.empty() ? scene.file.stem().string() : scene.title;
  for (const StudyPlot& plot : {error_plot(title, rows, reference), energy_plot(title, rows, scene)}) {
    if (plot.script.empty()) continue;
    if (!draw_plot(plot, output)) {
      say(quiet,
          "note: there is no program gnuplot in PATH (Debian: apt install gnuplot-nox), so the study has no plots");
      break;
    }
    report.plots.push_back(assets::read_file(output / (plot.name + ".svg")));
  }
  const std::filesystem::path file = output / "report.html";
  assets::write_file_atomically(file, study_html(report, rows, reference));
  return file;
}

}  // namespace

int run_study(const StudyArguments& a) {
  if (a.render) return run_study_render(a);
  const Clock::time_point start = Clock::now();
  use_threads(a.threads);
  if (a.regions) return run_stability_regions(a);
  if (a.scene.empty())
    throw UserError(ErrorKind::kUsage, "study needs a scene file (or --regions, which draws the integrators alone)");
  const double budget = parse_budget(a.budget);
  if (a.stability) return run_stability_map(a, budget);
  if (!a.apply.empty()) parse_target(a.apply);
  const std::filesystem::path target = a.apply.empty() ? std::filesystem::path() : apply_file(a);
  const SweepRequest request{a.scene,      a.overrides, a.integrators, a.substeps,
                             a.tolerances, a.linear,    a.resolutions, a.sweeps};
  const Sweep sweep = plan_sweep(request);
  if (sweep.scene.soft.empty() && sweep.scene.cloth.empty() && sweep.scene.springs.empty())
    throw UserError(ErrorKind::kUsage, a.scene,
                    "has no soft body, cloth or springs: study measures where bodies are, and scalar fields have no "
                    "places");
  if (sweep.scene.time.frames() < 2)
    throw UserError(ErrorKind::kUsage, a.scene, "is one frame long: nothing moves that could be measured");
  const std::filesystem::path output =
      a.output.empty() ? std::filesystem::path("out") / (std::filesystem::path(a.scene).stem().string() + "-study")
                       : std::filesystem::path(a.output);
  check_output_folder(output);
  promise_to_go_on();
  const std::filesystem::path cache = output / "cache";
  SharedShapes shapes(cache);
  const StudyPoints points =
      study_points(sweep.scene, shapes.of(sweep.scene), sweep.scene.reference ? sweep.scene.reference->body.place : "");
  const StudyReference reference =
      make_reference(request, sweep, points, shapes, cache, kReferencePart * budget, a.quiet);
  const StudyView view = view_of(sweep, reference, shapes);
  const StudyStore store(cache / "rows");
  const auto end = start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(budget));
  std::vector<std::string> hashes;
  const std::vector<StudyRow> rows =
      run_variants({sweep, points, reference, view, store, end, a.repeats, a.quiet}, shapes, hashes);
  if (std::none_of(rows.begin(), rows.end(), [](const StudyRow& r) { return r.run; }))
    throw UserError(ErrorKind::kUsage, fmt::format("--budget {}: is too small for one run; {}", a.budget,
                                                   rows.front().failure ? rows.front().failure->why : ""));
  StudyReport report;
  report.head = {
      a.scene, a.command, machine_text(), version_text(), sim::threads(), budget, warning_of(sweep, reference, rows)};
  report.lines = study_lines(rows, reference.size);
  if (sweep.scene.fields.empty()) report.pictures = pictures(sweep, rows, hashes, store, reference, shapes);
  const std::filesystem::path html = write_study(output, report, rows, reference, sweep.scene, a.quiet);
  if (!report.head.warning.empty()) say(a.quiet, "note: " + report.head.warning);
  fmt::print("{}", report.lines);
  if (!a.quiet) fmt::print("{}\n", html.string());
  if (!best_row(rows))
    throw UserError(ErrorKind::kSimulation, a.scene,
                    fmt::format("none of the {} runs came to its end; {} says why", rows.size(), html.string()));
  if (!a.apply.empty()) apply(target, a, rows, reference.size);
  return kDone;
}

}  // namespace softreel::app
