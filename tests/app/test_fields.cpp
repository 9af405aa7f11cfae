// Clips of scalar fields, end to end.
#include <cmath>

#include "app/clip_cache.h"
#include "sim/catalogue.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

std::string scene(const std::string& integrator, const std::string& field) {
  return "[time]\nduration = 0.2\nsubsteps = 4\nintegrator = \"" + integrator + "\"\n" + field +
         "[render]\nsize = [96, 54]\nsamples = 2\n";
}

const std::string kHeat =
    "[[field]]\nname = \"plate\"\nequation = \"heat\"\ngrid = { cells = [12, 12] }\ndiffusivity = 0.01\n"
    "source = \"x*t\"\ninitial = \"20 + 10*x\"\nfixed = [{ boundary = true, value = 20 }]\n";
const std::string kWave =
    "[[field]]\nname = \"water\"\nequation = \"wave\"\ngrid = { cells = [12, 12] }\nspeed = 0.5\n"
    "initial = \"exp(-50*(x^2+z^2))\"\nheight = 0.1\n";
const std::string kPoisson =
    "[[field]]\nname = \"skin\"\ngrid = { cells = [12, 12] }\nsource = 1\nfixed = [{ boundary = true }]\n";

test::RunResult render(const std::filesystem::path& file, const std::filesystem::path& out,
                       std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"render", file.string(), "-o", out.string(), "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run(arguments);
}

}  // namespace

TEST_CASE("a field that was interrupted goes on to the same bits, with every integrator of its equation") {
  for (const std::string equation : {"heat", "wave"})
    for (const sim::MethodInfo& info : sim::field_integrators(equation)) {
      const std::string name(info.name);
      CAPTURE(equation);
      CAPTURE(name);
      test::TempFolder folder;
      const auto file = folder.write("scene.toml", scene(name, equation == "heat" ? kHeat : kWave));
      REQUIRE(test::run({"simulate", file.string(), "-o", (folder / "whole").string()}).code == 0);
      REQUIRE(test::run({"simulate", file.string(), "-o", (folder / "part").string(), "--frames", "1-3"}).code == 0);
      REQUIRE(test::run({"simulate", file.string(), "-o", (folder / "part").string(), "--threads", "1"}).code == 0);
      const auto states = test::states_in(folder / "whole");
      CHECK(states.size() == 6);
      CHECK(states == test::states_in(folder / "part"));
    }
}

TEST_CASE("a field is drawn in the colours of its values, with its bar, new colours do not simulate again") {
  test::TempFolder folder;
  const auto file = folder.write("scene.toml", scene("implicit-euler", kPoisson));
  const auto stats = test::stats_of({"render", file.string(), "-o", (folder / "out").string()}, folder);
  CHECK(stats.at("frames_simulated") == 6);
  CHECK(stats.at("field_vertices") == 169);
  CHECK(stats.at("triangles") == 288);
  const auto before = test::pictures_in(folder / "out");
  CHECK(before.size() == 6);
  for (const std::string set : {"field.skin.colormap=magma", "field.skin.height=0.5", "field.skin.range=[0, 1]",
                                "field.skin.colorbar=false", "field.skin.label=u"}) {
    CAPTURE(set);
    const auto again = test::stats_of({"render", file.string(), "-o", (folder / "out").string(), "--set", set}, folder);
    CHECK(again.at("frames_simulated") == 0);
    CHECK(again.at("frames_rendered") == 6);
    CHECK(test::pictures_in(folder / "out") != before);
  }
  CHECK(
      test::stats_of({"render", file.string(), "-o", (folder / "out").string(), "--set", "field.skin.source=2"}, folder)
          .at("frames_simulated") == 6);
}

TEST_CASE("bodies and fields share a scene, each goes as it goes alone") {
  test::TempFolder folder;
  const std::string field = kHeat;
  const auto both = folder.write("both.toml", test::hanging_cloth() + field);
  const auto alone = folder.write("alone.toml", test::hanging_cloth());
  REQUIRE(render(both, folder / "both").code == 0);
  REQUIRE(render(alone, folder / "alone").code == 0);
  const auto cache = [&](const char* name) {
    for (const auto& entry : std::filesystem::directory_iterator(folder / name / "cache"))
      return app::ClipCache(folder / name / "cache", entry.path().filename().string().substr(4)).read(6);
    return std::optional<app::CachedFrame>();
  };
  const auto with = cache("both"), without = cache("alone");
  REQUIRE(with);
  REQUIRE(without);
  CHECK(with->state.x == without->state.x);
  CHECK(with->fields.size() == 1);
  CHECK(without->fields.empty());
}

TEST_CASE("fields are exported with their values, displaced as they are drawn") {
  test::TempFolder folder;
  const auto file = folder.write("scene.toml", scene("leapfrog", kWave + kHeat));
  CHECK(test::run({"simulate", file.string(), "-o", (folder / "bad").string()}).code == 2);  // heat takes no leapfrog
  const auto good = folder.write("wave.toml", scene("leapfrog", kWave));
  REQUIRE(test::run({"simulate", good.string(), "-o", (folder / "out").string(), "--export", "vtu"}).code == 0);
  const std::string vtu = test::slurp(folder / "out/export/water_0001.vtu");
  CHECK(test::contains(vtu, "Name=\"value\""));
  CHECK(test::contains(vtu, "Name=\"rate\""));
  CHECK_FALSE(test::contains(vtu, "velocity"));
  REQUIRE(test::run({"simulate", good.string(), "-o", (folder / "out").string(), "--export", "ply"}).code == 0);
  CHECK(std::filesystem::exists(folder / "out/export/water_0006.ply"));
}

TEST_CASE("the bill of a field alone has no body in it, and that of a body no field") {
  test::TempFolder folder;
  const auto file = folder.write("scene.toml", scene("implicit-euler", kHeat));
  const auto field = test::stats_of({"render", file.string(), "-o", (folder / "field").string()}, folder);
  const auto needs = field.at("needs").get<std::vector<std::string>>();
  CHECK(std::find(needs.begin(), needs.end(), "scalar fields") != needs.end());
  CHECK(std::find(needs.begin(), needs.end(), "colour bars") != needs.end());
  for (const char* left_out : {"tetrahedral solids", "membranes", "springs", "gravity", "Hessians and a linear solver"})
    CHECK(field.at("left_out").contains(left_out));
  const auto cloth_file = folder.write("cloth.toml", test::hanging_cloth());
  const auto cloth = test::stats_of({"render", cloth_file.string(), "-o", (folder / "cloth").string()}, folder);
  CHECK(cloth.at("left_out").contains("scalar fields"));
  CHECK(cloth.at("left_out").contains("colour bars"));
  CHECK_FALSE(cloth.contains("field_vertices"));
}

TEST_CASE("a step that is too long for an explicit method is refused before the run, with one that holds") {
  test::TempFolder folder;
  const std::string stiff =
      "[[field]]\nname = \"drum\"\nequation = \"wave\"\ngrid = { cells = [12, 12] }\nspeed = 50\n";
  const auto file = folder.write("scene.toml", scene("leapfrog", stiff));
  const test::RunResult refused = test::run({"simulate", file.string(), "-o", (folder / "out").string()});
  CHECK(refused.code == 2);
  CHECK(test::contains(refused.err, "field 'drum'"));
  const std::size_t at = refused.err.find("time.substeps = ", refused.err.find("without bound"));
  REQUIRE(at != std::string::npos);
  const int substeps = std::atoi(refused.err.c_str() + at + 16);
  CHECK(substeps > 4);
  const test::RunResult check = test::run({"check", file.string()});
  CHECK(check.code == 2);
  CHECK(check.err == refused.err);
  const std::string set = "time.substeps=" + std::to_string(substeps);
  CHECK(test::run({"simulate", file.string(), "-o", (folder / "out").string(), "--set", set}).code == 0);
  CHECK(test::run({"simulate", file.string(), "-o", (folder / "out").string(), "--set",
                   "time.substeps=" + std::to_string(substeps - 2)})
            .code == 2);
}

TEST_CASE("what only the mesh shows to be wrong with a field is a user's mistake") {
  test::TempFolder folder;
  struct Wrong {
    std::string field;
    const char* says;
  };
  const std::string grid = "[[field]]\ngrid = { cells = [4, 4] }\n";
  for (const Wrong& wrong :
       {Wrong{grid + "fixed = [{ box = [[5, 5, 5], [6, 6, 6]] }]\n", "holds no vertex"},
        Wrong{grid + "fixed = [{ boundary = true, value = \"1/(x+0.5)\" }]\n",
              "has no finite value at (-0.5, 0, -0.5)"},
        Wrong{grid + "source = \"ln(x)\"\nfixed = [{ boundary = true }]\n", "source has no finite value"}}) {
    const auto file = folder.write("scene.toml", scene("implicit-euler", wrong.field));
    const test::RunResult result = test::run({"simulate", file.string(), "-o", (folder / "out").string()});
    CHECK(result.code == 2);
    CHECK_MESSAGE(test::contains(result.err, wrong.says), result.err);
  }
}
