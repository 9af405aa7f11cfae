#include "app/study_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/stage.h"
#include "app/study_plot.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "assets/scene_names.h"
#include "assets/scene_rules.h"
#include "render/error_estimate.h"
#include "render/flip.h"
#include "sim/parallel.h"

namespace softreel::app {
namespace {

constexpr int kReference = 1024;
constexpr int kMost = 256;

struct Row {
  std::string preset;  // its name; empty: the scene with that number of samples
  int samples = 1;     // that were taken
  double seconds = 0;  // median
  double rms = 0;      // [levels of 255]
  double flip = 0;     // mean, 0 .. 1
};

/// Its own stage for each row: programs are compiled before the clock runs. Without repeats nothing is timed.
Row measure(const assets::Scene& scene, const Shapes& shapes, const ClipExtent& extent, const CachedFrame& frame,
            int repeats, render::FloatImage& film) {
  Stage stage(scene, shapes, extent);
  film = stage.draw_linear(frame);
  std::vector<double> seconds;
  double spent = 0;
  for (int i = 0; i < repeats && spent < 2; ++i) {
    stop_if_interrupted();
    const auto start = std::chrono::steady_clock::now();
    film = stage.draw_linear(frame);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    spent += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  return {"", stage.renderer().last_picture().samples, seconds.empty() ? 0.0 : seconds[seconds.size() / 2], 0, 0};
}

assets::Scene with_samples(assets::Scene scene, int samples) {
  scene.render.samples = samples;
  return scene;
}

assets::Scene with_preset(assets::Scene scene, assets::Quality quality) {
  scene.render.samples = assets::Render{}.samples;
  scene.render.quality = quality;
  assets::apply_quality(scene.render);
  return scene;
}

StudyPlot plot(const std::vector<Row>& rows) {
  std::string curve, presets;
  for (const Row& row : rows)
    (row.preset.empty() ? curve : presets) +=
        fmt::format("{} {} {} {} {}\n", row.samples, row.seconds, row.rms, row.flip, row.preset);
  return {"pictures", "$rows << EOD\n" + curve + "EOD\n$presets << EOD\n" + presets + R"(EOD
set logscale xyy2
set grid lc rgb "#e5e5e5"
set xlabel "time of a frame [s]"
set ylabel "RMS error [levels of 255]"
set ytics nomirror
set y2label "FLIP"
set y2tics
set key top right
plot $rows using 2:3 with linespoints lw 2 pt 7 ps 0.7 lc rgb "#0072b2" title "RMS", \
     $rows using 2:3:1 with labels offset 1.2,0.6 textcolor rgb "#333333" notitle, \
     $rows using 2:4 axes x1y2 with linespoints lw 2 pt 5 ps 0.6 lc rgb "#d55e00" title "FLIP, at the right", \
     $presets using 2:3 with points pt 6 ps 2 lw 2 lc rgb "#000000" title "presets, RMS", \
     $presets using 2:3:5 with labels left offset 1.2,-0.8 notitle
)"};
}

std::string csv_of(const std::vector<Row>& rows) {
  std::string csv = "samples,preset,seconds,rms_levels,flip\n";
  for (const Row& row : rows)
    csv += fmt::format("{},{},{:.6f},{:.6f},{:.6f}\n", row.samples, row.preset, row.seconds, row.rms, row.flip);
  return csv;
}

std::string json_of(const ClipPlan& plan, int frame, const std::vector<Row>& rows) {
  nlohmann::json json = {{"scene", plan.scene.file.string()},
                         {"frame", frame},
                         {"size", plan.scene.render.size},
                         {"reference_samples", kReference},
                         {"rows", nlohmann::json::array()}};
  for (const Row& row : rows) {
    json["rows"].push_back(
        {{"samples", row.samples}, {"seconds", row.seconds}, {"rms_levels", row.rms}, {"flip", row.flip}});
    if (!row.preset.empty()) json["rows"].back()["preset"] = row.preset;
  }
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

int run_study_render(const StudyArguments& a) {
  ClipArguments clip;
  clip.scene = a.scene;
  clip.overrides = a.overrides;
  clip.quiet = a.quiet;
  clip.threads = a.threads;
  clip.output =
      a.output.empty()
          ? (std::filesystem::path("out") / (std::filesystem::path(a.scene).stem().string() + "-study")).string()
          : a.output;
  ClipPlan plan = plan_clip(clip);
  // The middle of the clip: something has happened, and it shows.
  const int number = (plan.scene.time.frames() + 1) / 2;
  const int last = needs_whole_clip(plan.scene) ? plan.scene.time.frames() : number;
  const Shapes shapes = simulate_plan(plan, last, a.quiet);
  ClipExtent extent;
  std::optional<CachedFrame> frame;
  for (int f = 1; f <= last; ++f) {
    std::optional<CachedFrame> data = plan.cache.read(f);
    if (!data)
      throw assets::UserError(assets::ErrorKind::kInput, plan.cache.folder().string(), "a cached frame went missing");
    add_frame(plan.scene, shapes, *data, extent);
    if (f == number) frame = std::move(data);
  }
  const render::Environment shown;  // exposure 1: errors are comparable between scenes
  constexpr std::array kPresets = {assets::Quality::kDraft, assets::Quality::kDefault, assets::Quality::kFinal};
  std::vector<Row> rows;
  {
    int steps = 1 + static_cast<int>(kPresets.size());
    for (int samples = 1; samples <= kMost; samples *= 2) ++steps;
    Progress progress("study", steps, a.quiet);
    render::FloatImage reference, film;
    measure(with_samples(plan.scene, kReference), shapes, extent, *frame, 0, reference);
    const render::Image reference_picture = render::develop(reference, shown);
    progress.advance();
    const auto add = [&](const assets::Scene& scene, const std::string& preset) {
      Row row = measure(scene, shapes, extent, *frame, a.repeats, film);
      row.preset = preset;
      row.rms = render::shown_difference(film, reference, shown);
      row.flip = render::flip(reference_picture, render::develop(film, shown), {}, sim::threads()).mean;
      rows.push_back(row);
      progress.advance();
    };
    for (int samples = 1; samples <= kMost; samples *= 2) add(with_samples(plan.scene, samples), "");
    for (const assets::Quality preset : kPresets)
      add(with_preset(plan.scene, preset), std::string(assets::name_of(preset)));
  }
  fmt::print("frame {} of {}, {} x {}, against {} samples\n samples   seconds   RMS error [levels of 255]    FLIP\n",
             number, plan.scene.time.frames(), plan.scene.render.size[0], plan.scene.render.size[1], kReference);
  for (const Row& row : rows)
    fmt::print("{:8} {:9.3f} {:9.3f} {:25.4f}  {}\n", row.samples, row.seconds, row.rms, row.flip, row.preset);
  const std::filesystem::path file = plan.output / "pictures.csv";
  assets::write_file_atomically(file, csv_of(rows));
  assets::write_file_atomically(plan.output / "pictures.json", json_of(plan, number, rows));
  const bool drawn = draw_plot(plot(rows), plan.output);
  if (!drawn)
    say(a.quiet, "note: there is no program gnuplot in PATH (Debian: apt install gnuplot-nox), so there is no plot");
  if (!a.quiet) fmt::print("{}\n", (drawn ? plan.output / "pictures.svg" : file).string());
  return kDone;
}

}  // namespace softreel::app
