// One variant of a scene in memory.
#include "app/trial.h"

#include "assets/scene_reader.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

assets::Scene variant(std::vector<std::string> overrides = {}) {
  return assets::parse_scene(test::hanging_cloth(), "scene.toml", overrides);
}

}  // namespace

TEST_CASE("a trial gives the frames of the clip to the bit, and leaves no file") {
  test::TempFolder folder;
  const auto file = folder.write("scene.toml", test::hanging_cloth());
  REQUIRE(test::run({"simulate", file.string(), "-o", (folder / "out").string()}).code == 0);
  const assets::Scene scene = variant();
  app::SharedShapes shapes("");
  const app::Trial trial = app::run_trial(scene, shapes.of(scene));
  REQUIRE_FALSE(trial.failure);
  REQUIRE(trial.frames.size() == 6);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out/cache")) {
    const app::ClipCache cache(folder / "out/cache", entry.path().filename().string().substr(4));
    for (int f = 1; f <= 6; ++f) {
      const auto cached = cache.read(f);
      REQUIRE(cached);
      CHECK(cached->state.x == trial.frames[static_cast<size_t>(f - 1)].state.x);
      CHECK(cached->figures.energies.kinetic == trial.frames[static_cast<size_t>(f - 1)].figures.energies.kinetic);
    }
  }
  CHECK(trial.total.steps == 5 * scene.time.substeps);
  CHECK(trial.wall_seconds >= trial.total.seconds.total);
  CHECK(trial.processor_seconds > 0);
  CHECK(trial.peak_memory_bytes > 1 << 20);
}

TEST_CASE("a trial that cannot hold tells frame, time, step and reason instead of throwing") {
  app::SharedShapes shapes("");
  const assets::Scene wild = variant({"time.integrator=symplectic-euler", "cloth.sheet.springs.structural=1e9"});
  const app::Trial failed = app::run_trial(wild, shapes.of(wild));
  REQUIRE(failed.failure);
  CHECK(failed.failure->end == app::TrialEnd::kFailed);
  CHECK(failed.failure->frame >= 2);
  CHECK(failed.failure->step >= 1);
  CHECK(failed.failure->time == doctest::Approx(static_cast<double>(failed.failure->step - 1) * wild.time.step()));
  CHECK(test::contains(failed.failure->why, "ran away"));

  const assets::Scene unheld = variant({"cloth.sheet.pins=[{ box = [[5, 5, 5], [6, 6, 6]] }]"});
  const app::Trial refused = app::run_trial(unheld, shapes.of(unheld));
  REQUIRE(refused.failure);
  CHECK(refused.failure->end == app::TrialEnd::kRefused);
  CHECK(refused.frames.empty());
  CHECK(test::contains(refused.failure->why, "holds no vertex"));
}

TEST_CASE("a trial ends at its deadline, or when it is told to") {
  app::SharedShapes shapes("");
  const assets::Scene scene = variant();
  app::TrialOptions late;
  late.seconds = 0;
  const app::Trial cut = app::run_trial(scene, shapes.of(scene), late);
  REQUIRE(cut.failure);
  CHECK(cut.failure->end == app::TrialEnd::kBudget);
  app::TrialOptions told;
  told.stop = [](const app::ClipWorld& world, int frame) {
    return world.time() > 0.09 ? std::to_string(frame) : std::string();
  };
  const app::Trial stopped = app::run_trial(scene, shapes.of(scene), told);
  REQUIRE(stopped.failure);
  CHECK(stopped.failure->end == app::TrialEnd::kStopped);
  CHECK(stopped.failure->why == "4");  // t = 0.1 s
  CHECK(stopped.frames.size() == 4);
}

TEST_CASE("variants share their shapes unless a key changes a mesh") {
  app::SharedShapes shapes("");
  const app::Shapes& plain = shapes.of(variant());
  for (const char* same : {"time.substeps=9", "solver.tolerance=1e-6", "cloth.sheet.springs.structural=7",
                           "cloth.sheet.density=300", "gravity=[0, -1, 0]", "damping.drag=1"})
    CHECK(&shapes.of(variant({same})) == &plain);
  for (const char* other :
       {"cloth.sheet.grid.cells=[3, 3]", "cloth.sheet.translate=[0, 1, 0]", "cloth.sheet.grid.size=[2, 1]"})
    CHECK(&shapes.of(variant({other})) != &plain);
}
