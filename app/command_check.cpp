// softreel check SCENE
#include <fmt/format.h>

#include <optional>

#include "app/accurate_clip.h"
#include "app/arguments.h"
#include "app/bill.h"
#include "app/exit_code.h"
#include "app/field_world.h"
#include "app/forecast_text.h"
#include "app/forecast_warnings.h"
#include "app/method_list.h"
#include "app/world.h"
#include "assets/error.h"
#include "assets/scene_reader.h"
#include "assets/scene_reference.h"

namespace softreel::app {
namespace {

/// Tetrahedra of an earlier run are not made again, but check leaves no files behind.
std::filesystem::path cache_of_renders(const std::string& scene) {
  std::filesystem::path cache = std::filesystem::path("out") / std::filesystem::path(scene).stem() / "cache";
  std::error_code none;
  return std::filesystem::is_directory(cache, none) ? cache : std::filesystem::path();
}

}  // namespace

int run_check(const CheckArguments& a) {
  if (a.list) {
    fmt::print("{}{}\n{}", method_list_text(), assets::scene_choices_text(), assets::scene_reference_markdown());
    return kDone;
  }
  if (a.scene.empty())
    throw assets::UserError(assets::ErrorKind::kUsage, "check needs a scene file (or --list, for every key there is)");
  const assets::Scene scene = assets::read_scene(a.scene, a.overrides);
  assets::check_assets(scene);
  // What only the meshes show: pins that hold nothing, steps that are too long.
  const Shapes shapes = load_shapes(scene, cache_of_renders(a.scene));
  build_fields(scene, shapes);
  const sim::Model model = build_model(scene, shapes);
  const std::string steps =
      scene.time.accuracy
          ? fmt::format("steps as an error of {} {} needs them", scene.time.accuracy->value, scene.time.accuracy->unit)
          : fmt::format("{} steps of {:.4g} s", (scene.time.frames() - 1) * scene.time.substeps, scene.time.step());
  fmt::print("{}: no mistakes. {} frames at {:g} fps, {}\n\n", a.scene, scene.time.frames(), scene.time.fps, steps);
  for (const std::string& note : scene.notes)
    fmt::print("note: {}\n{}", note, &note == &scene.notes.back() ? "\n" : "");
  for (const std::string& note : shapes.notes) fmt::print("note: {}\n", note);
  std::optional<Forecast> forecast;
  // Where an accuracy is asked for, the steps are not known before the run.
  if (model.vertices() > 0 && scene.time.integrator != "static" && !scene.time.accuracy)
    forecast = make_forecast(scene, model);
  if (forecast) fmt::print("{}\n", forecast_text(scene, model, *forecast));
  if (scene.time.accuracy) fmt::print("{}\n\n", accurate_steps_text(scene, shapes));
  const std::vector<std::string> warnings = warnings_of(scene, shapes, model, forecast ? &*forecast : nullptr);
  for (const std::string& warning : warnings)
    fmt::print("warning: {}\n{}", warning, &warning == &warnings.back() ? "\n" : "");
  const std::vector<BillItem> bill = bill_of(scene);
  for (const bool needed : {true, false}) {
    fmt::print("{}\n", needed ? "needed" : "left out");
    for (const BillItem& item : bill)
      if (item.needed == needed) fmt::print("  {:<30} {}\n", item.feature, item.why);
  }
  return kDone;
}

}  // namespace softreel::app
