#include "app/study_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/stage.h"
#include "app/study_plot.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "render/error_estimate.h"

namespace softreel::app {
namespace {

constexpr int kReference = 1024;
constexpr int kMost = 256;

struct Row {
  int samples = 1;
  double seconds = 0;  // median
  double error = 0;    // RMS [levels of 255]
};

/// Its own stage for each number of samples: programs are compiled before the clock runs.
Row measure(assets::Scene scene, const Shapes& shapes, const ClipExtent& extent, const CachedFrame& frame, int samples,
            int repeats, render::FloatImage& film) {
  scene.render.samples = samples;
  Stage stage(scene, shapes, extent);
  film = stage.draw_linear(frame);
  std::vector<double> seconds;
  double spent = 0;
  for (int i = 0; i < repeats && (i == 0 || spent < 2); ++i) {
    stop_if_interrupted();
    const auto start = std::chrono::steady_clock::now();
    film = stage.draw_linear(frame);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    spent += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  return {samples, seconds[seconds.size() / 2], 0};
}

StudyPlot plot(const std::vector<Row>& rows) {
  std::string data = "$rows << EOD\n";
  for (const Row& row : rows) data += fmt::format("{} {} {}\n", row.samples, row.seconds, row.error);
  return {"pictures", data + R"(EOD
set logscale xy
set grid lc rgb "#e5e5e5"
set xlabel "time of a frame [s]"
set ylabel "RMS error [levels of 255]"
set key off
plot $rows using 2:3 with linespoints lw 2 pt 7 ps 0.7 lc rgb "#0072b2", \
     $rows using 2:3:1 with labels offset 1.2,0.6 textcolor rgb "#333333"
)"};
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
  render::FloatImage reference;
  std::vector<Row> rows;
  {
    Progress progress("study", 10, a.quiet);
    measure(plan.scene, shapes, extent, *frame, kReference, 1, reference);
    progress.advance();
    for (int samples = 1; samples <= kMost; samples *= 2) {
      render::FloatImage film;
      rows.push_back(measure(plan.scene, shapes, extent, *frame, samples, a.repeats, film));
      rows.back().error = render::shown_difference(film, reference, shown);
      progress.advance();
    }
  }
  std::string csv = "samples,seconds,rms_levels\n";
  fmt::print("frame {} of {}, {} x {}, against {} samples\n samples   seconds   RMS error [levels of 255]\n", number,
             plan.scene.time.frames(), plan.scene.render.size[0], plan.scene.render.size[1], kReference);
  for (const Row& row : rows) {
    csv += fmt::format("{},{:.6f},{:.6f}\n", row.samples, row.seconds, row.error);
    fmt::print("{:8} {:9.3f} {:9.3f}\n", row.samples, row.seconds, row.error);
  }
  const std::filesystem::path file = plan.output / "pictures.csv";
  assets::write_file_atomically(file, csv);
  const bool drawn = draw_plot(plot(rows), plan.output);
  if (!drawn)
    say(a.quiet, "note: there is no program gnuplot in PATH (Debian: apt install gnuplot-nox), so there is no plot");
  if (!a.quiet) fmt::print("{}\n", (drawn ? plan.output / "pictures.svg" : file).string());
  return kDone;
}

}  // namespace softreel::app
