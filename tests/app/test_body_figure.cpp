// Figures of the simulation at the vertices of a body.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "app/body_figure.h"
#include "app/clip_world.h"
#include "app/shapes.h"
#include "app/world.h"
#include "assets/scene_reader.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

/// A block of 0.4 x 0.2 x 0.4 m and 1000 kg/m^3 on the ground.
const std::string kResting =
    "[time]\nduration = 3\nfps = 10\nsubsteps = 6\n[damping]\nalpha = 2\n"
    "[[soft]]\nname = \"block\"\nblock = { size = [0.4, 0.2, 0.4], cells = [4, 2, 4] }\ntranslate = [0, 0.102, 0]\n"
    "density = 1000\nmaterial = { young = 1e6 }\ndata = \"pressure\"\n"
    "[[collider]]\nshape = \"plane\"\n";

}  // namespace

TEST_CASE("The contact pressure under a block at rest carries its weight, awake and asleep") {
  const test::TempFolder folder;
  std::vector<std::string> overrides;
  SUBCASE("awake") { overrides = {"contact.sleep_speed=0"}; }
  SUBCASE("asleep") {}
  const assets::Scene scene = assets::read_scene(folder.write("scene.toml", kResting), overrides);
  const app::Shapes shapes = app::load_shapes(scene, {});
  REQUIRE(app::shows_pressure(scene));
  app::ClipWorld world(scene, shapes);
  const app::BodyFigure figure(scene.soft[0], shapes.soft[0], 0);
  for (int frame = 2; frame <= scene.time.frames(); ++frame) {
    sim::StepReport sum;
    for (int step = 0; step < scene.time.substeps; ++step) REQUIRE_FALSE(world.step(scene.time.step(), sum));
    const app::CachedFrame now = world.frame(sum);
    if (frame < 20) continue;
    CHECK(now.figures.asleep.value_or(0) == (overrides.empty() ? 1 : 0));
    double up = 0;
    for (int i = 0; i < world.vertices(); ++i) up += now.contact_force(3 * i + 1);
    const double weight = 1000 * 0.4 * 0.2 * 0.4 * 9.81;
    CHECK(up == doctest::Approx(weight).epsilon(0.01));
    // As a force over the surface: all of it on the lower side, none above.
    const Eigen::VectorXd pressure = figure.values(now);
    double carried = 0;
    for (const sim::Triangle& t : sim::boundary_triangles(shapes.soft[0].rest)) {
      const auto at = [&](int k) -> sim::Vec3 { return now.state.x.segment<3>(3 * t[k]); };
      const double third = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 6;
      for (const int vertex : t) carried += pressure(vertex) * third;
    }
    CHECK(carried == doctest::Approx(weight).epsilon(0.01));
    for (int i = 0; i < world.vertices(); ++i)
      if (now.state.x(3 * i + 1) > 0.05) CHECK(pressure(i) == 0);
  }
}

TEST_CASE("Frames hold contact forces only where a body shows pressure, and a resumed run the same") {
  const test::TempFolder folder;
  std::string scene = kResting;
  const auto states = [&](const std::string& name, int frames) {
    const auto file = folder.write("scene.toml", scene);
    const auto r = test::run(
        {"simulate", file.string(), "-o", (folder / name).string(), "--frames", "1-" + std::to_string(frames)});
    REQUIRE(r.code == 0);
    return test::states_in(folder / name);
  };
  const auto whole = states("whole", 12);
  states("parts", 5);
  CHECK(states("parts", 12) == whole);
  scene.replace(scene.find("data = \"pressure\""), 17, "data = \"speed\"   ");
  const auto plain = states("plain", 12);
  CHECK(plain.begin()->second.size() < whole.begin()->second.size());
}
