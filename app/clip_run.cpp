#include "app/clip_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "app/accurate_clip.h"
#include "app/forecast.h"
#include "app/frame_range.h"
#include "app/hashes.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "app/progress.h"
#include "app/world.h"
#include "assets/error.h"
#include "assets/scene_reader.h"
#include "sim/parallel.h"

namespace softreel::app {

void use_threads(int threads) {
  if (threads <= 0) return;
  sim::set_threads(threads);
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
}

ClipPlan plan_clip(const ClipArguments& a) {
  use_threads(a.threads);
  assets::Scene scene = assets::read_scene(a.scene, a.overrides);
  assets::check_assets(scene);
  std::vector<int> frames = parse_frames(a.frames, scene.time.frames());
  const std::filesystem::path output = a.output.empty()
                                           ? std::filesystem::path("out") / std::filesystem::path(a.scene).stem()
                                           : std::filesystem::path(a.output);
  check_output_folder(output);
  if (!a.stats.empty()) check_output_file(a.stats);
  promise_to_go_on();
  const std::string hash = simulation_hash(scene);
  ClipPlan plan{std::move(scene), output, std::move(frames), ClipCache(output / "cache", hash), a.force, {}};
  plan.figures.scene = a.scene;
  plan.figures.simulation_hash = hash;
  plan.figures.bill = bill_of(plan.scene);
  plan.figures.accuracy = plan.scene.time.accuracy;
  plan.figures.frames_asked = static_cast<int>(plan.frames.size());
  return plan;
}

Shapes simulate_plan(ClipPlan& plan, int last, bool quiet) {
  const auto start = std::chrono::steady_clock::now();
  Shapes shapes = load_shapes(plan.scene, plan.cache.folder().parent_path());
  RunFigures& f = plan.figures;
  f.tetrahedralize = shapes.tetrahedralize_seconds;
  f.load = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() - f.tetrahedralize;
  for (const std::string& note : plan.scene.notes) say(quiet, "note: " + note);
  for (const std::string& note : shapes.notes) say(quiet, "note: " + note);
  for (const SolidShape& s : shapes.soft) {
    f.tets += static_cast<long>(s.rest.tets.size());
    f.vertices += static_cast<long>(s.rest.vertices.size());
    f.triangles += static_cast<long>(s.drawn.surface.triangles.size());
  }
  for (const ClothShape& c : shapes.cloth) {
    f.vertices += static_cast<long>(c.rest.vertices.size());
    f.triangles += static_cast<long>(c.rest.triangles.size());
  }
  for (const SpringShape& s : shapes.springs) {
    f.vertices += static_cast<long>(s.rest.size());
    if (s.drawn) f.triangles += static_cast<long>(s.drawn->mesh().triangles.size());
  }
  for (const ClothShape& c : shapes.fields) {
    f.field_vertices += static_cast<long>(c.rest.vertices.size());
    f.triangles += static_cast<long>(c.rest.triangles.size());
  }
  if (plan.cache.complete_frames(last) < last) {
    if (!plan.force && !plan.scene.time.accuracy && has_step_limit(plan.scene))
      refuse_hopeless(plan.scene, build_model(plan.scene, shapes));
    f.simulated = true;
    f.clip = plan.scene.time.accuracy ? simulate_to_accuracy(plan.scene, shapes, plan.cache, quiet)
                                      : simulate_clip(plan.scene, shapes, plan.cache, last, quiet);
  } else {
    f.clip.frames_from_cache = last;
  }
  return shapes;
}

}  // namespace softreel::app
