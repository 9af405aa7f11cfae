// What check says of a scene's stability, and that real runs bear it out.
#include <cmath>
#include <regex>

#include "app/forecast.h"
#include "app/stability_outcome.h"
#include "app/trial.h"
#include "app/world.h"
#include "assets/scene_reader.h"
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

struct World {
  assets::Scene scene;
  app::Shapes shapes;
  sim::Model model;

  World(const test::TempFolder& folder, const std::string& text, const std::vector<std::string>& overrides = {})
      : scene(assets::read_scene(folder.write("scene.toml", text).string(), overrides)),
        shapes(app::load_shapes(scene, {})),
        model(app::build_model(scene, shapes)) {}

  app::Forecast forecast() const { return app::make_forecast(scene, model); }

  /// The scene in `steps` steps of h, a frame after each tenth.
  app::Outcome run(double h, int steps) const {
    assets::Scene s = scene;
    s.time.substeps = 10;
    s.time.fps = 0.1 / h;
    s.time.duration = 10 * h * (steps / 10 + 1);
    return app::outcome_of(s, app::run_trial(s, shapes));
  }
};

const std::string kTime = "[time]\nfps = 30\nduration = 1\nsubsteps = 4\nintegrator = \"symplectic-euler\"\n";

// So light that it hardly stretches: what stretches is faster than the forecast from the start.
const std::string kSheet = "gravity = [0, -0.5, 0]\n" + kTime + R"([[cloth]]
name = "sheet"
grid = { size = [0.5, 0.5], cells = [5, 5] }
material = { young = 2e4, poisson = 0.3, thickness = 1e-3, bending = 1e-4 }
pins = [{ vertices = [0, 5] }]
)";

const std::string kSpringSheet = kTime + R"([[cloth]]
name = "sheet"
grid = { size = [0.5, 0.5], cells = [5, 5] }
model = "mass-spring"
springs = { structural = 300 }
spring_damping = 0.02
pins = [{ vertices = [0, 5] }]
)";

const std::string kBlock = kTime + R"([[soft]]
name = "block"
block = { size = [0.2, 0.2, 0.2], cells = [2, 2, 2] }
material = { young = 1e5, poisson = 0.4 }
spin = [0, 0, 90]
)";

const std::string kChain = kTime + R"([[springs]]
name = "chain"
chain = { from = [0, 0, 0], to = [1, 0, 0], links = 8 }
stiffness = [2000]
pins = [{ vertices = [0] }]
)";

// Lies down on the ground from a height of less than the distance of contact.
const std::string kResting = kTime + R"([[soft]]
name = "block"
block = { size = [0.2, 0.2, 0.2], cells = [2, 2, 2] }
material = { young = 1e5, poisson = 0.4 }
translate = [0, 0.1015, 0]
[[collider]]
friction = 0
)";

std::string check(const std::string& text, const std::vector<std::string>& overrides = {}) {
  test::TempFolder folder;
  std::vector<std::string> arguments = {"check", folder.write("scene.toml", text).string()};
  for (const std::string& o : overrides) arguments.insert(arguments.end(), {"--set", o});
  const test::RunResult result = test::run(arguments);
  CHECK(result.code == 0);
  CHECK(result.err.empty());
  return result.out;
}

}  // namespace

TEST_CASE("Real runs hold at 0.95 of the forecast step and blow up at 1.05: sheets, springs, a solid, a chain") {
  test::TempFolder folder;
  for (const std::string& scene : {kSheet, kSpringSheet, kBlock, kChain})
    for (const char* integrator : {"symplectic-euler", "verlet", "rk4"}) {
      CAPTURE(scene);
      CAPTURE(std::string(integrator));
      const World world(folder, scene, {std::string("time.integrator=") + integrator});
      const double limit = world.forecast().largest_step();
      REQUIRE(std::isfinite(limit));
      const app::Outcome below = world.run(0.95 * limit, 300), above = world.run(1.05 * limit, 300);
      CHECK(below != app::Outcome::kBlewUp);
      // rk4 damps what the fastest mode feeds, so that in a sheet, which can fold, it may grow no further.
      if (std::string(integrator) == "rk4")
        CHECK(above != app::Outcome::kHeld);
      else
        CHECK(above == app::Outcome::kBlewUp);
    }
}

TEST_CASE("In contact the forecast of bodies that touch is safe, and that of bodies that do not fails") {
  test::TempFolder folder;
  const World world(folder, kResting);
  const app::Forecast f = world.forecast();
  REQUIRE(f.touching);
  CHECK(f.touching->largest_step < f.apart.largest_step);
  CHECK(f.touching->largest_step > 0.8 * f.apart.largest_step);  // sqrt(3)/2: (h omega)^2 + 1 < 4
  CHECK(world.run(0.95 * f.touching->largest_step, 600) != app::Outcome::kBlewUp);
  CHECK(world.run(1.05 * f.apart.largest_step, 600) == app::Outcome::kBlewUp);
}

TEST_CASE("The setting that check recommends holds, and check then says so") {
  test::TempFolder folder;
  for (const std::string& scene : {kSheet, kSpringSheet, kBlock}) {
    const app::Forecast f = World(folder, scene).forecast();
    CHECK(f.verdict == app::Verdict::kHopeless);
    REQUIRE(f.substeps > 4);
    const std::string substeps = "time.substeps=" + std::to_string(f.substeps);
    const World recommended(folder, scene, {substeps});
    CHECK(recommended.forecast().verdict == app::Verdict::kHolds);
    // The fewest that leave so much.
    const double longer = recommended.forecast().largest_step() / recommended.scene.time.step();
    CHECK(longer * (1 - app::kSpare) > 0.99);
    CHECK(longer * (1 - app::kSpare) * (f.substeps - 1) / f.substeps < 1.01);
    CHECK(app::outcome_of(recommended.scene, app::run_trial(recommended.scene, recommended.shapes)) ==
          app::Outcome::kHeld);
  }
}

TEST_CASE("check prints frequency, limit, growth and what to do, and says what holds") {
  const std::string bad = check(kBlock);
  CHECK(std::regex_search(bad, std::regex("symplectic-euler at h = 1/120 s is unstable: h omega = [0-9.]+, limit 2; "
                                          "over the clip a motion grows 1e[0-9]+-fold; use time.substeps = [0-9]+, or "
                                          "time.integrator = \"implicit-euler\"")));
  CHECK(std::regex_search(bad, std::regex("fastest motion +[0-9.e+]+ rad/s .* in 'block' near")));
  const std::string good = check(kBlock, {"time.integrator=implicit-euler"});
  CHECK(test::contains(good, "holds: implicit-euler has no limit on the step"));
  CHECK(test::contains(good, "artificial loss"));
  CHECK_FALSE(test::contains(check(kBlock, {"time.integrator=newmark"}), "artificial loss"));
  CHECK(test::contains(check(kBlock, {"time.integrator=forward-euler", "time.substeps=100"}), "unstable"));
  CHECK(test::contains(check(kBlock, {"time.integrator=implicit-euler", "solver.method=fixed-point"}),
                       "diverges: h omega"));
}

TEST_CASE("check tells what an accuracy will do to the step instead of judging one") {
  const std::string out = check(kBlock, {"time.accuracy=\"1 mm\""});
  CHECK(test::contains(out, "steps as an error of 1 mm needs them"));
  CHECK_FALSE(test::contains(out, "is unstable"));
  CHECK_FALSE(test::contains(check(kBlock), "steps as an error"));
}

TEST_CASE("What implicit Euler takes from a motion of 1 Hz per second is what the oscillator loses") {
  const std::string out = check(kChain, {"time.integrator=implicit-euler"});
  std::smatch match;
  REQUIRE(std::regex_search(out, match, std::regex("by implicit-euler alone: ([0-9.]+) % at 1 Hz")));
  const double w = 2 * 3.14159265358979 / 120;  // (1 + w^2)^(-1/2) a step
  CHECK(std::stod(match[1]) == doctest::Approx(100 * (1 - std::pow(1 + w * w, -60))).epsilon(0.05));
}

TEST_CASE("render and simulate refuse a hopeless step with exit code 2, and --force simulates it all the same") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", kBlock).string(), out = (folder / "out").string();
  for (const char* command : {"render", "simulate"}) {
    const test::RunResult refused = test::run({command, scene, "-o", out});
    CHECK(refused.code == 2);
    CHECK(test::contains(refused.err, "is unstable: h omega"));
    CHECK(test::contains(refused.err, "use time.substeps = "));
    CHECK(test::contains(refused.err, "--force"));
  }
  CHECK(test::states_in(folder / "out").empty());
  CHECK(test::run({"simulate", scene, "-o", out, "--force"}).code == 4);
  CHECK(test::run({"simulate", scene, "-o", out, "--set", "time.substeps=60", "--frames", "1-3"}).code == 0);
}

TEST_CASE("check says that a pin holds no vertex, which only the mesh shows") {
  test::TempFolder folder;
  const auto file = folder.write("scene.toml", kBlock + "pins = [{ box = [[5, 5, 5], [6, 6, 6]] }]\n");
  test::check_refused({"pin", {"check", file.string()}, 2, {"holds no vertex", "block"}});
}

TEST_CASE("check warns of what makes scenes fail, each with its figure, and of nothing in a scene without it") {
  const std::string calm = "[time]\nintegrator = \"implicit-euler\"\n" + kBlock.substr(kTime.size());
  CHECK_FALSE(test::contains(check(calm), "warning"));
  CHECK(test::contains(check(calm, {"soft.block.material.poisson=0.495"}), "99 times stiffer than shear"));
  CHECK(test::contains(check(calm, {"soft.block.block.size=[0.2, 0.2, 1e-4]"}), "nearly flat"));
  CHECK(test::contains(check(kSheet, {"time.integrator=implicit-euler", "cloth.sheet.material.thickness=0.1"}),
                       "no thin sheet"));
  const std::string dropped = calm + "translate = [0, 1, 0]\n";
  CHECK(test::contains(check(dropped + "[[collider]]\nname = \"pea\"\nshape = \"sphere\"\nradius = 0.02\n"),
                       "collider 'pea' is 0.04 m thin"));
  const std::string lamp = calm + "[[light]]\nkind = \"area\"\nradius = 0.01\nposition = [0.02, 0.01, 0.03]\n";
  CHECK(test::contains(check(lamp), "light 1 stands inside 'block'"));
  CHECK_FALSE(test::contains(check(lamp, {"light.1.position=[0.2, 0.01, 0.03]"}), "stands inside"));
  const std::string over_ball =
      "[time]\n" + kSheet.substr(kSheet.find("[[cloth]]")) +
      "[[collider]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.25\ntranslate = [0, -0.26, 0]\n";
  CHECK(test::contains(check(over_ball), "where 'sheet' bends around collider 'ball', its edges, up to 0.141 m long"));
  CHECK_FALSE(test::contains(check(over_ball, {"cloth.sheet.grid.cells=[40, 40]"}), "bends around"));
  CHECK_FALSE(test::contains(check(over_ball, {"contact.distance=0.012"}), "bends around"));
  const std::string thrown =
      "velocity = [0, -50, 0]\n[[collider]]\nname = \"board\"\nshape = \"box\"\nsize = [1, 0.3, "
      "1]\n";
  CHECK(test::contains(check(dropped + thrown), "may come out on the other side"));
  const std::string driven = check("[time]\nsubsteps = 1\n" + kBlock.substr(kTime.size()) +
                                   "pins = [{ vertices = [0], motion = [{ t = 0 }, { t = 0.1, translate = [2, 0, 0] "
                                   "}] }]\n");
  CHECK(test::contains(driven, "pin 1 of 'block' is driven at up to 20 m/s"));
  CHECK(test::contains(check(kResting, {"time.substeps=40", "collider.1.friction=0.5"}), "trembles"));
  CHECK(test::contains(check(calm + "[wind]\ngusts = { amplitude = 0.5 }\n"), "wind.gusts have no effect"));
  CHECK(test::contains(check(calm, {"time.integrator=newmark", "soft.block.material.young=1e9"}), "damps nothing"));
  CHECK(test::contains(check(kBlock + "[solver]\ntolerance = 1e-4\n", {"time.substeps=100"}),
                       "has no effect: symplectic-euler is explicit"));
  CHECK(test::contains(check(calm + "[contact]\ndistance = 1e-3\n"), "there is no collider"));
  const std::string tied = check(calm + R"([[springs]]
name = "feather"
points = [[0, 0.2, 0], [0, 0.3, 0]]
edges = [[0, 1]]
mass = [1e-7]
[[attach]]
bodies = ["feather", "block"]
near = 0.15
)");
  CHECK(test::contains(tied, "ties 'feather'"));
  CHECK(test::contains(tied, "masses that differ"));
}
