#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

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
