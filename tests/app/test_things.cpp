// Clips of points, loads, ties and wind, end to end.
#include <cmath>

#include "assets/state_file.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

const char* const kPictures = "[render]\nsize = [48, 32]\nsamples = 2\n";

std::string rendered(const std::string& text, const test::TempFolder& folder, std::vector<std::string> more = {}) {
  const auto scene = folder.write("scene.toml", text + kPictures);
  std::vector<std::string> arguments = {"render", scene.string(), "-o", (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const test::RunResult result = test::run(arguments);
  CHECK_MESSAGE(result.code == 0, result.err);
  return result.err;
}

const std::string kPendulum = R"(
[time]
duration = 0.2
[[springs]]
name = "pendulum"
points = [[0, 0, 0], [0.5, 0, 0]]
edges = [[0, 1]]
stiffness = 1e4
pins = [{ vertices = [0] }]
)";

}  // namespace

TEST_CASE("A pendulum alone is simulated and drawn, and exported as it is drawn") {
  test::TempFolder folder;
  rendered(kPendulum, folder);
  const auto pictures = test::pictures_in(folder / "out");
  CHECK(pictures.size() == 6);
  CHECK(pictures.begin()->second != pictures.rbegin()->second);  // it swings
  const test::RunResult exported =
      test::run({"simulate", (folder / "scene.toml").string(), "-o", (folder / "out").string(), "--export", "ply"});
  CHECK_MESSAGE(exported.code == 0, exported.err);
}

TEST_CASE("A point that is joined to nothing is noted") {
  test::TempFolder folder;
  const std::string notes = rendered(
      "[time]\nduration = 0.1\n[[springs]]\nname = \"dust\"\npoints = [[0, 0, 0], [1, 0, 0], [2, 1, 0]]\nedges = [[0, "
      "1]]\n",
      folder);
  CHECK(test::contains(notes, "springs 'dust': 1 of 3 points is joined to nothing"));
}

TEST_CASE("The same wind gives the same bits for any number of threads, and another seed other ones") {
  const std::string text = test::hanging_cloth() +
                           "[wind]\nvelocity = [1, 0, 4]\nfriction = 0.1\ngusts = { amplitude = 0.5, period = 0.5 }\n"
                           "[damping]\ndrag = 0.5\n";
  const auto states = [&](const std::vector<std::string>& more) {
    test::TempFolder folder;
    const auto scene = folder.write("scene.toml", text);
    std::vector<std::string> arguments = {"simulate", scene.string(), "-o", (folder / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::RunResult result = test::run(arguments);
    CHECK_MESSAGE(result.code == 0, result.err);
    return test::states_in(folder / "out");
  };
  const auto one = states({"--threads", "1"});
  CHECK(one.size() == 6);
  CHECK(one == states({"--threads", "2"}));
  CHECK(one != states({"--threads", "2", "--set", "wind.gusts.seed=5"}));
}
