// Contact between surfaces as a user meets it: keys, refusals, figures.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assets/surface_import.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

/// Two blocks, the upper one `gap` above the lower one, and what else is said.
std::string two_blocks(double gap, const std::string& more = "") {
  return "[time]\nduration = 0.4\nfps = 10\nsubsteps = 3\n"
         "[[soft]]\nname = \"lower\"\nblock = { size = [0.4, 0.2, 0.4], cells = [2, 1, 2] }\ntranslate = [0, 0.11, 0]\n"
         "[[soft]]\nname = \"upper\"\nblock = { size = [0.2, 0.2, 0.2], cells = [1, 1, 1] }\ntranslate = [0.03, " +
         std::to_string(0.31 + gap) +
         ", 0.02]\n"
         "[[collider]]\nshape = \"plane\"\n[render]\nsize = [48, 32]\nsamples = 1\n" +
         more;
}

test::RunResult run(const test::TempFolder& folder, const std::string& scene, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"simulate", folder.write("scene.toml", scene).string(), "-o",
                                        (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run(arguments);
}

nlohmann::json stats(const std::string& scene) {
  test::TempFolder folder;
  return test::stats_of({"simulate", folder.write("scene.toml", scene).string(), "-o", (folder / "out").string()},
                        folder);
}

}  // namespace

TEST_CASE("bodies that fall on each other do not cross, and the stats tell what contact did") {
  const auto j = stats(two_blocks(0.05));
  REQUIRE(j.at("crossings").size() == 4);
  for (const auto& count : j.at("crossings")) CHECK(count == 0);
  CHECK(j.at("contact").at("active").back() > 0);
  CHECK(j.at("contact").at("smallest_gap").back() > 0);
  CHECK(j.at("contact").at("sticks").back().get<long>() + j.at("contact").at("slips").back().get<long>() > 0);
  // A single body, and bodies that are told to pass through each other, have no such stage.
  const auto apart = stats(two_blocks(0.05, "[[contact.pair]]\nbetween = [\"lower\", \"upper\"]\ntouch = false\n"));
  CHECK_FALSE(apart.contains("crossings"));
  CHECK_FALSE(apart.contains("contact"));
}

TEST_CASE("bodies that overlap in the first frame are refused with their names, or moved apart if asked") {
  test::TempFolder folder;
  const test::RunResult refused = run(folder, two_blocks(-0.07));
  CHECK(refused.code == 2);
  CHECK(refused.err.find("'lower' and 'upper'") != std::string::npos);
  CHECK(refused.err.find("resolve_overlap") != std::string::npos);
  const auto j = stats(two_blocks(-0.07, "[contact]\nresolve_overlap = true\n"));
  for (const auto& count : j.at("crossings")) CHECK(count == 0);
  // What whole bodies cannot be moved out of is still refused.
  const test::RunResult pinned = run(folder, two_blocks(-0.07, "[contact]\nresolve_overlap = true\n"),
                                     {"--set", "soft.*.pins=[{ box = [[-9, -9, -9], [9, 9, 9]] }]"});
  CHECK(pinned.code == 2);
}

TEST_CASE("a body wholly inside another is refused with both names, or moved out if asked") {
  const std::string frame = "gravity = [0, 0, 0]\n[time]\nduration = 0.2\nfps = 10\n";
  const std::string outer = "[[soft]]\nname = \"outer\"\nblock = { size = [0.6, 0.6, 0.6], cells = [2, 2, 2] }\n";
  const std::string inner =
      "[[soft]]\nname = \"inner\"\nblock = { size = [0.1, 0.1, 0.1], cells = [1, 1, 1] }\ntranslate = [0.05, 0, 0]\n";
  test::TempFolder folder;
  for (const std::string& text : {frame + outer + inner, frame + inner + outer}) {
    const test::RunResult refused = run(folder, text);
    CHECK(refused.code == 2);
    CHECK(refused.err.find("'inner' inside 'outer'") != std::string::npos);
  }
  const std::string cloth =
      "[[cloth]]\nname = \"flag\"\ngrid = { size = [0.1, 0.1], cells = [2, 2] }\ntranslate = [0, 0.05, 0]\n";
  CHECK(run(folder, frame + outer + cloth).err.find("'flag' inside 'outer'") != std::string::npos);
  const test::RunResult moved =
      run(folder, frame + "[contact]\nresolve_overlap = true\n" + outer + inner, {"--export", "ply"});
  REQUIRE(moved.code == 0);
  Eigen::AlignedBox3d box;
  for (const sim::Vec3& p : assets::import_surface(folder / "out" / "export" / "inner_0001.ply").welded.vertices)
    box.extend(p);
  CHECK(box.min().cwiseAbs().maxCoeff() > 0.3);
  // What may hold others is no solid, and what does not touch may be anywhere.
  CHECK(
      run(folder, frame + outer + inner + "[[contact.pair]]\nbetween = [\"inner\", \"outer\"]\ntouch = false\n").code ==
      0);
  folder.write(
      "room.obj",
      "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
      "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 4 7 3\nf 4 8 7\nf 1 5 8\nf 1 8 4\nf 2 3 7\nf 2 7 6\n");
  CHECK(run(folder, frame + inner + "[[collider]]\nname = \"room\"\nshape = \"mesh\"\nmesh = \"room.obj\"\n").code ==
        0);
}

TEST_CASE("bodies that overlap aslant are moved apart along the faces that overlap") {
  // Both turned by 45 degrees, 2 cm into each other along the diagonal; weightless, so they stay where they are put.
  const std::string text =
      "gravity = [0, 0, 0]\n[time]\nduration = 0.2\nfps = 10\n[contact]\nresolve_overlap = true\n"
      "[[soft]]\nname = \"a\"\nblock = { size = [0.4, 0.4, 0.4], cells = [1, 1, 1] }\nrotate = [0, 0, 45]\n"
      "[[soft]]\nname = \"b\"\nblock = { size = [0.4, 0.4, 0.4], cells = [1, 1, 1] }\nrotate = [0, 0, 45]\n"
      "translate = [0.2687, 0.2687, 0.013]\n";
  test::TempFolder folder;
  const test::RunResult r = run(folder, text, {"--export", "ply"});
  REQUIRE(r.code == 0);
  double leftmost = 1;
  for (const sim::Vec3& p : assets::import_surface(folder / "out" / "export" / "b_0001.ply").welded.vertices)
    leftmost = std::min(leftmost, p.x());
  // 0.38 m apart, and then 0.4 m and the contact distance: 2.2 cm along the diagonal. Along an axis it would be 30 cm.
  CHECK(leftmost == doctest::Approx(0.2687 + 0.022 / std::sqrt(2.0) - 0.2 * std::sqrt(2.0)).epsilon(1e-3));
}

TEST_CASE("a mesh collider carries what falls on it, and is said to be missing where it is") {
  test::TempFolder folder;
  folder.write("table.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 3 2\nf 1 4 3\n");
  const std::string text =
      "[time]\nduration = 0.5\nfps = 10\nsubsteps = 3\n"
      "[[soft]]\nname = \"box\"\nblock = { size = [0.2, 0.2, 0.2], cells = [1, 1, 1] }\ntranslate = [0, 0.13, 0]\n"
      "[[collider]]\nname = \"table\"\nshape = \"mesh\"\nmesh = \"table.obj\"\nmotion = [{ t = 0 }, { t = 1, translate "
      "= "
      "[0, 0.5, 0] }]\n[render]\nsize = [48, 32]\nsamples = 1\n";
  const std::string scene = folder.write("scene.toml", text).string();
  const auto j = test::stats_of({"render", scene, "-o", (folder / "out").string()}, folder);
  for (const auto& count : j.at("crossings")) CHECK(count == 0);
  CHECK(j.at("left_out").contains("contact with colliders"));
  const test::RunResult none = run(folder, "[[soft]]\nblock = { }\n[[collider]]\nshape = \"mesh\"\n");
  CHECK(none.code == 2);
  CHECK(none.err.find("add mesh = ") != std::string::npos);
}

TEST_CASE("pairs of contact name what has a surface") {
  test::TempFolder folder;
  const test::RunResult unknown = run(folder, two_blocks(0.1, "[[contact.pair]]\nbetween = [\"lower\", \"uper\"]\n"));
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("did you mean \"upper\"?") != std::string::npos);
  const test::RunResult simple =
      run(folder, two_blocks(0.1, "[[contact.pair]]\nbetween = [\"lower\", \"collider-1\"]\n"));
  CHECK(simple.code == 2);
  CHECK(simple.err.find("simple shape") != std::string::npos);
  const test::RunResult mute =
      run(folder, two_blocks(0.1, "[[contact.pair]]\nbetween = [\"lower\", \"upper\"]\ntouch = false\nfriction = 1\n"));
  CHECK(mute.code == 2);
  CHECK(mute.err.find("has no effect with touch = false") != std::string::npos);
}
