#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "render/png.h"
#include "render/renderer.h"
#include "tests/render/scratch_folder.h"

using namespace softreel::render;
using softreel::render::test::read_bytes;
using softreel::render::test::ScratchFolder;

namespace {

Image picture() {
  RenderOptions options;
  options.width = 200;
  options.height = 120;
  options.samples = 4;
  options.seed = 3;
  Renderer renderer(options);
  Look metal;
  metal.metallic = 1;
  metal.roughness = 0.2f;
  renderer.add_shape(make_sphere(0.5f), metal);
  Shape cloth = make_plane(2, 2, 60);
  for (glm::vec3& p : cloth.positions) p.y = -0.6f + 0.2f * std::sin(5 * p.x + 3 * p.z);
  Look look;
  look.two_sided = true;
  look.sheen = 0.4f;
  renderer.add_shape(cloth, look);
  const Camera camera = frame_bounds(renderer.bounds(), 40, 200.0f / 120);
  Stage stage = default_stage(renderer.bounds(), camera, true, -1);
  stage.environment.sky_shadow = true;
  return renderer.render(camera, stage.lights, stage.environment);
}

}  // namespace

TEST_CASE("writes the picture of the determinism test" * doctest::skip()) {
  const char* path = std::getenv("SOFTREEL_TEST_PICTURE");
  if (path != nullptr) write_png(path, picture());
}

TEST_CASE("a picture has the same bits again, and with one, two or more threads") {
  const Image here = picture();
  CHECK(picture() == here);
  const ScratchFolder folder;
  for (const int threads : {0, 1, 2, 5}) {
    const std::string path = (folder / fmt::format("{}.png", threads)).string();
    // A process of its own: the driver reads the number of its threads once.
    const std::string command = fmt::format(
        "LP_NUM_THREADS={} SOFTREEL_TEST_PICTURE='{}' '{}' --no-skip "
        "--test-case='writes the picture of the determinism test' > /dev/null",
        threads, path, std::filesystem::read_symlink("/proc/self/exe").string());
    REQUIRE(std::system(command.c_str()) == 0);
    CHECK(read_bytes(path) == encode_png(here));
  }
}

TEST_CASE("a picture of what has not changed is not drawn again, and has the bits that drawing it would give") {
  Renderer renderer({64, 36, 4, 0, 0});
  Look look;
  look.color_map = 0;
  const MeshId plane = renderer.add_mesh(make_plane(1, 1, 4).mesh, {look});
  const std::vector<glm::vec3> positions = make_plane(1, 1, 4).positions;
  renderer.set_positions(plane, positions);
  const MeshId ball = renderer.add_shape(make_sphere(0.3f), {});
  const Camera camera = frame_bounds(renderer.bounds(), 40, 64.0f / 36);
  Stage stage = default_stage(renderer.bounds(), camera, true, -0.5f);
  std::size_t reused = 0;
  const auto draw = [&](const Camera& from) {
    const Image shown = renderer.render(from, stage.lights, stage.environment);
    // Drawn whatever came before.
    CHECK(shown == develop(renderer.render_linear(from, stage.lights, stage.environment), stage.environment));
    return renderer.counters().pictures_reused - std::exchange(reused, renderer.counters().pictures_reused);
  };
  CHECK(draw(camera) == 0);
  CHECK(draw(camera) == 1);
  renderer.set_positions(plane, positions);  // the same ones
  CHECK(draw(camera) == 1);

  std::vector<glm::vec3> moved = positions;
  moved[7].y += 0.1f;
  renderer.set_positions(plane, moved);
  CHECK(draw(camera) == 0);
  renderer.set_values(plane, std::vector<float>(moved.size(), 0.5f));
  CHECK(draw(camera) == 0);
  renderer.set_transform(ball, glm::mat4(0.9f));
  CHECK(draw(camera) == 0);
  renderer.set_visible(ball, false);
  CHECK(draw(camera) == 0);
  renderer.set_seed(7);
  CHECK(draw(camera) == 0);
  stage.lights.front().intensity *= 0.5f;
  CHECK(draw(camera) == 0);
  stage.environment.exposure = 2;
  CHECK(draw(camera) == 0);
  CHECK(draw(orbit(camera, glm::vec3(0), 10)) == 0);
  CHECK(draw(orbit(camera, glm::vec3(0), 10)) == 1);
}
