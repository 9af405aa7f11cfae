// What a scene does not need is not done: shown by the stats of real runs, and told by `check`.
#include "assets/export_pc2.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

nlohmann::json stats(const std::string& text, std::vector<std::string> more = {}) {
  test::TempFolder folder;
  const auto ball = test::sphere(1);
  assets::write_obj(folder / "ball.obj", ball.vertices, ball.triangles);
  std::vector<std::string> arguments = {
      "render", folder.write("scene.toml", text).string(), "-o", (folder / "out").string(), "--frames", "1-2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::stats_of(arguments, folder);
}

bool has(const nlohmann::json& json, const char* section, const char* key) {
  return json.contains(section) && json.at(section).contains(key);
}

bool left_out(const nlohmann::json& json, const char* feature) { return has(json, "left_out", feature); }

const std::string kSurface =
    "[[soft]]\nmesh = \"ball.obj\"\nmaterial = { young = 1e4 }\n[render]\nsize = [32, 24]\nsamples = 2\n";

}  // namespace

TEST_CASE("A mass-spring scene never calls TetGen, a surface to fill does") {
  const auto springs = stats(test::hanging_cloth());
  CHECK_FALSE(has(springs, "seconds", "tetrahedralize"));
  CHECK(left_out(springs, "tetrahedralization (TetGen)"));
  CHECK(springs.at("tets") == 0);
  const auto surface = stats(kSurface);
  CHECK(has(surface, "seconds", "tetrahedralize"));
  CHECK_FALSE(left_out(surface, "tetrahedralization (TetGen)"));
  CHECK(surface.at("tets") > 0);
}

TEST_CASE("An explicit scene never assembles or solves, an implicit one does") {
  const auto explicit_steps =
      stats(test::hanging_cloth(), {"--set", "time.integrator=symplectic-euler", "--set", "time.substeps=100"});
  CHECK(explicit_steps.at("steps") == 100);
  CHECK(has(explicit_steps, "simulate_seconds", "gradient"));
  CHECK_FALSE(has(explicit_steps, "simulate_seconds", "assemble"));
  CHECK_FALSE(has(explicit_steps, "simulate_seconds", "solve"));
  CHECK_FALSE(explicit_steps.contains("solver"));
  CHECK(explicit_steps.at("newton_iterations") == 0);
  CHECK(left_out(explicit_steps, "Hessians and a linear solver"));
  const auto implicit_steps = stats(test::hanging_cloth());
  CHECK(has(implicit_steps, "simulate_seconds", "assemble"));
  CHECK(has(implicit_steps, "simulate_seconds", "solve"));
  CHECK(has(implicit_steps, "solver", "chosen"));
}

TEST_CASE("A scene without colliders has no contact stage, one with a collider has") {
  const auto without = stats(test::hanging_cloth());
  CHECK_FALSE(has(without, "simulate_seconds", "contact"));
  CHECK(left_out(without, "contact with colliders"));
  const auto with = stats(test::small_scene());
  CHECK(has(with, "simulate_seconds", "contact"));
  CHECK_FALSE(left_out(with, "contact with colliders"));
}

TEST_CASE("One sample has no accumulation buffer, two have") {
  const auto one = stats(test::hanging_cloth(), {"--set", "render.samples=1"});
  CHECK_FALSE(has(one, "render_counters", "accumulation_buffers"));
  CHECK(one.at("render_counters").at("passes") == 2);
  CHECK(left_out(one, "accumulation buffer"));
  const auto two = stats(test::hanging_cloth());
  CHECK(has(two, "render_counters", "accumulation_buffers"));
  CHECK(two.at("render_counters").at("passes") == 4);
}

TEST_CASE("Lights without shadow draw no shadow maps") {
  const std::string dark = test::hanging_cloth() + "[[light]]\nkind = \"sun\"\nshadow = false\n";
  const auto without = stats(dark, {"--set", "light.1.shadow=false", "--set", "render.sky_shadow=false"});
  CHECK_FALSE(has(without, "render_counters", "shadow_maps"));
  CHECK_FALSE(has(without, "render_counters", "shadow_passes"));
  CHECK(left_out(without, "shadow maps"));
  CHECK(has(stats(dark), "render_counters", "shadow_passes"));
}

TEST_CASE("Loads, ties, wind and points are needed where the scene has them, and nowhere else") {
  const char* const kFeatures[] = {"loads", "attachments", "wind"};
  const auto without = stats(test::hanging_cloth());
  for (const char* feature : kFeatures) CHECK(left_out(without, feature));
  const auto with = stats(test::hanging_cloth() + R"(
[[springs]]
name = "weights"
points = [[-0.3, 0, 0.3], [0.3, 0, 0.3], [0, -0.4, 0.3]]
edges = [[0, 2], [1, 2]]
[[load]]
body = "weights"
box = [[-1, -1, -1], [1, 1, 1]]
force = [0, -0.1, 0]
[[attach]]
bodies = ["weights", "sheet"]
near = 0.01
[wind]
velocity = [0, 0, 2]
)");
  for (const char* feature : kFeatures) CHECK_FALSE(left_out(with, feature));
  CHECK_FALSE(left_out(with, "springs"));
  CHECK(with.at("vertices") == 49 + 3);
  CHECK(with.at("triangles") > without.at("triangles"));  // balls and rods
}

TEST_CASE("check prints the same bill as the stats of a run") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::small_scene()).string();
  const test::RunResult check = test::run({"check", scene});
  REQUIRE(check.code == 0);
  const std::size_t divide = check.out.find("\nleft out\n");
  REQUIRE(divide != std::string::npos);
  const std::string needed = check.out.substr(0, divide), omitted = check.out.substr(divide);
  const auto run = stats(test::small_scene());
  for (const auto& feature : run.at("needs")) CHECK(test::contains(needed, feature.get<std::string>()));
  for (const auto& [feature, why] : run.at("left_out").items()) {
    CHECK(test::contains(omitted, feature));
    CHECK(test::contains(omitted, why.get<std::string>()));
  }
  CHECK_FALSE(std::filesystem::exists("out/scene"));
}
