// What compare sees and what leaves it quiet, on frames that softreel renders.
#include "render/image_io.h"
#include "render/png.h"
#include "tests/app/clip.h"
#include "tests/app/comparison.h"
#include "tests/app/raw_png.h"

using namespace softreel;
namespace fs = std::filesystem;

namespace {

/// A tetrahedron-shaped thing of four vertices as OBJ; the top one further right by `shift` [m].
std::string pyramid(double shift) {
  return "v -0.3 0 0.3\nv 0.3 0 0.3\nv 0 0 -0.3\nv " + std::to_string(shift) +
         " 0.6 0\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n";
}

/// Two bodies under a lamp, 160 x 90, seen from a fixed place: a pixel is about 11 mm.
std::string two_bodies(const std::string& second = R"(
[[cloth]]
name = "right"
grid = { size = [0.5, 0.5], cells = [2, 2] }
rotate = [90, 0, 0]
translate = [0.5, 0.3, 0]
look = { color = "teal" }
)") {
  return R"(gravity = [0, 0, 0]
[time]
duration = 0.04
[camera]
position = [0, 0.6, 3]
target = [0, 0.3, 0]
fov = 20
[[cloth]]
name = "left"
mesh = "pyramid.obj"
translate = [-0.35, 0, 0]
look = { color = "#c06040" }
[[light]]
position = [2, 3, 2]
radius = 0.4
[render]
size = [160, 90]
samples = 16
sky_shadow = false
ground = { show = "on" }
)" + second;
}

/// The first rung that holds, in words.
std::string rung(const fs::path& a, const fs::path& b) {
  for (const char* name : {"bytes", "pixels", "driver", "perceptual"}) {
    const test::RunResult result = test::compare(a, b, {"--tolerance", name});
    REQUIRE(result.code <= 1);
    if (result.code == 0) return name;
  }
  return "none";
}

}  // namespace

TEST_CASE("One thing changed at a time: which rung still forgives it") {
  test::TempFolder folder;
  const auto render = [&](const std::string& name, const std::string& scene, std::vector<std::string> more = {}) {
    const fs::path file = folder.write(name + ".toml", scene), out = folder / name;
    more.insert(more.begin(), {"render", file.string(), "-o", out.string(), "--frames", "1", "--quiet"});
    const test::RunResult result = test::run(more);
    INFO(result.err);
    REQUIRE(result.code == 0);
    return out / "frame_0001.png";
  };
  folder.write("pyramid.obj", pyramid(0));
  const fs::path reference = render("reference", two_bodies());
  const auto forgiven = [&](const fs::path& actual) {
    const test::RunResult shown = test::compare(reference, actual, {"--tolerance", "perceptual"});
    MESSAGE(actual.parent_path().filename().string() << ": " << shown.out);
    return rung(reference, actual);
  };
  CHECK(forgiven(render("again", two_bodies())) == "bytes");
  CHECK(forgiven(render("seed", two_bodies(), {"--set", "render.seed=7"})) == "perceptual");
  CHECK(forgiven(render("lamp", two_bodies(), {"--set", "light.1.intensity=1.02"})) == "none");
  CHECK(forgiven(render("missing", two_bodies(""))) == "none");

  // One vertex by a pixel: driver sees it; it is close to the limit of perceptual.
  folder.write("pyramid.obj", pyramid(0.012));
  const std::string vertex = forgiven(render("vertex", two_bodies()));
  CHECK((vertex == "perceptual" || vertex == "none"));

  render::Image image = render::load_image(reference);
  for (std::size_t i = 0; i < image.rgba.size() / 2; ++i)
    if (i % 4 == 2) image.rgba[i] = static_cast<std::uint8_t>(image.rgba[i] > 0 ? image.rgba[i] - 1 : 1);
  render::write_png(folder / "level.png", image);  // one level of blue over half of the picture
  CHECK(forgiven(folder / "level.png") == "none");
}

TEST_CASE("A folder against its scene, rendered afresh: good, changed, and frames that have no reference yet") {
  test::TempFolder folder;
  folder.write("pyramid.obj", pyramid(0));
  const fs::path scene = folder.write("scene.toml", two_bodies()), reference = folder / "reference";
  const auto set = [&](const char* samples) { return std::vector<std::string>{"--set", samples}; };
  std::vector<std::string> made = set("render.samples=2");
  made.insert(made.end(), {"--frames", "1", "--update"});
  CHECK(test::compare(reference, scene, made).code == 0);
  CHECK(test::pictures_in(reference).size() == 1);
  CHECK(test::compare(reference, scene, set("render.samples=2")).code == 0);
  CHECK(test::compare(reference / "frame_0001.png", scene, set("render.samples=2")).code == 0);
  const test::RunResult other =
      test::compare(reference, scene, {"--set", "render.samples=2", "--set", "cloth.left.translate=[0,0,0]"});
  INFO(other.out << other.err);
  CHECK(other.code == 1);
  CHECK(test::compare(folder / "none", scene).code == 3);
  CHECK(test::compare(reference, folder.write("broken.toml", "nothing = 1")).code == 2);
}

TEST_CASE("Quiet: another number of threads, a resumed run, PNGs packed differently, any number of workers") {
  test::TempFolder folder;
  const fs::path scene = folder.write("scene.toml", test::hanging_cloth());
  const auto render = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", scene.string(), "-o", (folder / name).string(), "--quiet"});
    REQUIRE(test::run(more).code == 0);
    return folder / name;
  };
  const fs::path one = render("one", {"--threads", "1"}), two = render("two", {"--threads", "2"});
  render("resumed", {"--frames", "1-3"});
  const fs::path resumed = render("resumed", {});
  for (const fs::path& actual : {two, resumed})
    for (const char* workers : {"1", "2", "5"}) {
      const test::RunResult same = test::compare(one, actual, {"--tolerance", "bytes", "--threads", workers});
      INFO(same.out);
      CHECK(same.code == 0);
    }
  const fs::path packed = folder / "packed";
  fs::create_directories(packed);
  for (const auto& [name, bytes] : test::pictures_in(one)) {
    // Rows unfiltered and stored, not compressed: other bytes, the same pixels.
    const render::Image image = render::load_image(one / name);
    std::ofstream(packed / name, std::ios::binary) << test::stored_png(image);
  }
  const test::RunResult same = test::compare(one, packed, {"--tolerance", "pixels"});
  INFO(same.out << same.err);
  CHECK(same.code == 0);
  CHECK(test::compare(one, packed, {"--tolerance", "bytes"}).code == 1);
}

TEST_CASE("A body that is masked by the ids that its clip came with does not count, edges and all") {
  test::TempFolder folder;
  folder.write("pyramid.obj", pyramid(0));
  const auto render = [&](const std::string& name, const std::string& color) {
    const fs::path scene = folder.write(name + ".toml", two_bodies());
    REQUIRE(test::run({"render", scene.string(), "-o", (folder / name).string(), "--quiet", "--set", "render.id=true",
                       "--set", "cloth.right.look.color=\"" + color + "\""})
                .code == 0);
    return folder / name;
  };
  const fs::path teal = render("teal", "teal"), coral = render("coral", "coral");
  CHECK(test::compare(teal, coral).code == 1);
  const auto masked = [&](const std::string& id) {
    return test::compare(teal, coral, {"--tolerance", "pixels", "--ids", teal.string(), "--mask-id", id});
  };
  const test::RunResult right = masked("3");
  INFO(right.out << right.err);
  CHECK(right.code == 0);  // 0 nothing, 1 the ground, 2 the left one
  CHECK(masked("2").code == 1);
}
