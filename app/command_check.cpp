// softreel check SCENE
#include <fmt/format.h>

#include "app/arguments.h"
#include "app/bill.h"
#include "app/exit_code.h"
#include "app/field_world.h"
#include "app/method_list.h"
#include "assets/error.h"
#include "assets/scene_reader.h"
#include "assets/scene_reference.h"

namespace softreel::app {

int run_check(const CheckArguments& a) {
  if (a.list) {
    fmt::print("{}{}\n{}", method_list_text(), assets::scene_choices_text(), assets::scene_reference_markdown());
    return kDone;
  }
  if (a.scene.empty())
    throw assets::UserError(assets::ErrorKind::kUsage, "check needs a scene file (or --list, for every key there is)");
  const assets::Scene scene = assets::read_scene(a.scene, a.overrides);
  assets::check_assets(scene);
  if (!scene.fields.empty()) {  // what only their meshes show, the longest step above all
    Shapes shapes;
    load_fields(scene, shapes);
    build_fields(scene, shapes);
  }
  fmt::print("{}: no mistakes. {} frames at {:g} fps, {} steps of {:.4g} s\n\n", a.scene, scene.time.frames(),
             scene.time.fps, (scene.time.frames() - 1) * scene.time.substeps, scene.time.step());
  for (const std::string& note : scene.notes)
    fmt::print("note: {}\n{}", note, &note == &scene.notes.back() ? "\n" : "");
  const std::vector<BillItem> bill = bill_of(scene);
  for (const bool needed : {true, false}) {
    fmt::print("{}\n", needed ? "needed" : "left out");
    for (const BillItem& item : bill)
      if (item.needed == needed) fmt::print("  {:<30} {}\n", item.feature, item.why);
  }
  return kDone;
}

}  // namespace softreel::app
