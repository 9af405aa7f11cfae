#include <doctest/doctest.h>

#include "test_scene_help.h"

namespace softreel::assets {

namespace {
const char* const kText = R"(
[[soft]]
name = "spot"
block = {}
material = "rubber"
pins = [{ box = [[0, 0, 0], [1, 1, 1]] }]
[[soft]]
block = {}
)";
}

TEST_CASE("--set changes what is there and makes the sections that are not") {
  const Scene scene = parse(kText, {"soft.spot.material.young=1e5", "render.samples=4", "title=a long shot",
                                    "time.integrator=symplectic-euler", "soft.spot.look=red", "camera.fov = 20",
                                    "gravity=[0, -1.62, 0]", "soft.spot.block.cells=[2, 2, 2]", "time.fps=50"});
  CHECK(scene.soft[0].material.young == 1e5);
  CHECK(scene.soft[0].material.poisson == 0.47);  // the preset's
  CHECK(scene.render.samples == 4);
  CHECK(scene.title == "a long shot");
  CHECK(scene.time.integrator == "symplectic-euler");
  CHECK(scene.soft[0].look.color);
  CHECK(scene.camera.fov == 20);
  CHECK(scene.gravity == Vec3(0, -1.62, 0));
  CHECK(scene.soft[0].block->cells == std::array{2, 2, 2});
  CHECK(scene.time.fps == 50);
}

TEST_CASE("--set finds entries of a list by name, by number, and all of them by *") {
  const Scene scene = parse(kText, {"soft.*.density=500", "soft.2.density=600", "soft.soft-2.scale=3",
                                    "soft.spot.pins.1.axes=y", "light.1.intensity=2"});
  CHECK(scene.soft[0].density == 500);
  CHECK(scene.soft[1].density == 600);
  CHECK(scene.soft[1].transform.scale == Vec3(3, 3, 3));
  CHECK(scene.soft[0].pins[0].axes == std::array{false, true, false});
  CHECK(scene.lights.at(0).intensity == 2);
}

TEST_CASE("the last of several overrides of one key holds") {
  CHECK(parse(kText, {"render.samples=4", "render.samples=8"}).render.samples == 8);
}

TEST_CASE("text on the command line needs no quotes, and colours none either") {
  const Scene scene = parse(kText, {"soft.spot.look.color=#ff0000", "soft.2.look.color=teal", "title=\"quoted\""});
  CHECK(scene.soft[0].look.color == Color{1, 0, 0});
  CHECK(scene.soft[1].look.color);
  CHECK(scene.title == "quoted");
}

TEST_CASE("a wrong override is reported as the override, with what was meant") {
  struct Wrong {
    const char* set;
    const char* says;
  };
  const Wrong wrongs[] = {
      {"render.samples", "expected key=value"},
      {"=4", "expected key=value"},
      {"", "expected key=value"},
      {"render.sampels=4", "did you mean \"samples\"?"},
      {"rendr.samples=4", "did you mean \"render\"?"},
      {"samples=4", "belongs in [render]"},
      {"render..samples=4", "unknown key"},
      {"render.samples.x=4", "single value"},
      {"render=4", "expected a table"},
      {"render.samples=many", "render.samples: found the string \"many\", expected a whole number"},
      {"render.samples=0", "render.samples: found 0"},
      {"render.samples=", "found the string \"\""},
      {"camera.position=[1, 2", "not valid TOML"},
      {"soft.spto.density=3", "there is no \"spto\" in [[soft]]; did you mean \"spot\"?"},
      {"soft.nope.density=3", "there is: spot, 2, or * for all"},
      {"soft.3.density=3", "there is no \"3\""},
      {"soft.0.density=3", "there is no \"0\""},
      {"soft.spot=3", "whole entry"},
      {"cloth.*.density=3", "the scene has no [[cloth]]"},
      {"soft.*.densty=3", "did you mean \"density\"?"},
      {"soft.spot.density=-3", "soft.spot.density: found -3"},
      {"soft.spot.pins.2.axes=x", "there is no \"2\" in [[soft.pins]]"},
      {"soft=[]", "nothing to simulate"},
      {"soft.spot.material=ruber", "soft.spot.material: found the string \"ruber\""},
      {"soft.spot.mesh=a.obj", "both mesh and block"},
      {"time.fps=1\nduration=2", "found the string"},
  };
  for (const Wrong& wrong : wrongs) {
    CAPTURE(wrong.set);
    const std::vector<Problem> problems = problems_of(kText, {wrong.set});
    REQUIRE(problems.size() == 1);
    CAPTURE(problems[0].text());
    CHECK(contains(problems[0].message, wrong.says));
  }
  CHECK(problems_of(kText, {"render.samples=0"})[0].file == "--set render.samples=0");
}

}  // namespace softreel::assets
