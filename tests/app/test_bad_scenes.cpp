// Scenes that cannot be rendered: each is answered by an exit code and a sentence before any work is done.
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

struct BadScene {
  std::string what, text;
  int code;
  std::vector<std::string> says;
};

const std::string kCloth = "[[cloth]]\nname = \"sheet\"\ngrid = { size = [1, 1], cells = [4, 4] }\n";

const std::vector<BadScene> kBadScenes = {
    {"syntax error", "[time\nfps = 30\n", 2, {"scene.toml:1"}},
    {"string that does not end", "title = \"no end\n", 2, {"scene.toml:1"}},
    {"bytes that are no text", std::string("\x00\xff\xfe\x01\x80", 5), 2, {"scene.toml"}},
    {"unknown key", kCloth + "colour = \"red\"\n", 2, {"scene.toml:4", "colour"}},
    {"misspelled section", kCloth + "[rendr]\nsamples = 4\n", 2, {"rendr", "render"}},
    {"wrong type", kCloth + "[time]\nfps = \"thirty\"\n", 2, {"scene.toml:5", "fps"}},
    {"NaN", kCloth + "density = nan\n", 2, {"density"}},
    {"infinity", "gravity = [0, -inf, 0]\n" + kCloth, 2, {"gravity"}},
    {"billion cells", "[[cloth]]\ngrid = { size = [1, 1], cells = [32000, 32000] }\n", 2, {"cells"}},
    {"too many tetrahedra", "[[soft]]\nblock = { size = [1, 1, 1], cells = [1000, 1000, 1000] }\n", 2, {"cells"}},
    {"picture of 100,000 pixels a side", kCloth + "[render]\nsize = [100000, 100000]\n", 2, {"size", "8192"}},
    {"no pixels", kCloth + "[render]\nsize = [0, 32]\n", 2, {"size"}},
    {"duration 0", kCloth + "[time]\nduration = 0\n", 2, {"duration"}},
    {"endless duration", kCloth + "[time]\nduration = 1e9\n", 2, {"duration"}},
    {"negative density", kCloth + "density = -200\n", 2, {"density", "-200"}},
    {"Poisson's ratio of 0.5", "[[soft]]\nblock = {}\nmaterial = { poisson = 0.5 }\n", 2, {"poisson"}},
    {"unknown material model",
     "[[soft]]\nblock = {}\nmaterial = { model = \"steel\" }\n",
     2,
     {"steel", "stable-neo-hookean"}},
    {"missing mesh", "[[soft]]\nname = \"a\"\nmesh = \"none.obj\"\n", 3, {"scene.toml:3", "none.obj"}},
    {"mesh is a folder", "[[soft]]\nmesh = \".\"\n", 3, {"folder"}},
    {"missing texture", kCloth + "look = { texture = \"none.png\" }\n", 3, {"none.png"}},
    {"body without a shape", "[[soft]]\nname = \"ghost\"\n", 2, {"no shape"}},
    {"pin that holds nothing",
     kCloth + "pins = [{ box = [[5, 5, 5], [6, 6, 6]] }]\n",
     2,
     {"pin 1 of 'sheet'", "holds no vertex"}},
    {"pin on a vertex that is not there", kCloth + "pins = [{ vertices = [99] }]\n", 2, {"99", "0 to 24"}},
    {"load that finds no vertex",
     kCloth + "[[load]]\nbody = \"sheet\"\nbox = [[5, 5, 5], [6, 6, 6]]\nforce = [0, 1, 0]\n",
     2,
     {"load 'load-1' finds no vertex of 'sheet'", "reaches from (-0.5, 0, -0.5) to (0.5, 0, 0.5)"}},
    {"traction on half a triangle",
     kCloth + "[[load]]\nbody = \"sheet\"\nbox = [[0.4, -1, 0.4], [1, 1, 1]]\ntraction = [0, 1, 0]\n",
     2,
     {"no surface triangle of 'sheet'", "all corners"}},
    {"attachment out of reach",
     kCloth + "[[soft]]\nname = \"b\"\nblock = {}\ntranslate = [0, 9, 0]\n[[attach]]\nbodies = [\"sheet\", "
              "\"b\"]\nnear = 1\n",
     2,
     {"attachment 'attach-1' ties nothing", "within 1 m of 'b'"}},
    {"attachment of free points",
     "[[springs]]\nname = \"p\"\npoints = [[0, 0, 0]]\n[[springs]]\nname = \"q\"\npoints = [[1, 0, 0]]\n"
     "[[attach]]\nbodies = [\"p\", \"q\"]\nnear = 2\n",
     2,
     {"needs a stiffness"}},
    {"two bodies of one name", kCloth + kCloth, 2, {"sheet"}},
    {"camera inside its target", kCloth + "[camera]\nposition = [1, 1, 1]\ntarget = [1, 1, 1]\n", 2, {"target"}},
    {"empty file", "", 2, {"scene.toml"}},
    {"scene without a body", "[time]\nfps = 30\n", 2, {"scene.toml"}},
};

}  // namespace

TEST_CASE("Scenes that cannot hold are refused with a place and a reason") {
  for (const BadScene& bad : kBadScenes) {
    test::TempFolder folder;
    const auto scene = folder.write("scene.toml", bad.text);
    test::check_refused({bad.what, {"render", scene.string(), "-o", (folder / "out").string()}, bad.code, bad.says});
    INFO(bad.what);
    CHECK(test::pictures_in(folder / "out").empty());
    test::check_only_whole_files(folder.path());
  }
}

TEST_CASE("All mistakes of a scene are reported at once") {
  test::TempFolder folder;
  const auto scene = folder.write("scene.toml", kCloth + "density = -1\n[time]\nfps = 0\n[camera]\nfov = 500\n");
  test::check_refused({"three mistakes", {"check", scene.string()}, 2, {"density", "fps", "fov"}});
}

TEST_CASE("What is given as a scene and is none is refused") {
  test::TempFolder folder;
  const std::string path = folder.path().string();
  folder.write("nest.toml", "a = " + std::string(100000, '[') + std::string(100000, ']'));
  folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* command : {"render", "simulate", "check"}) {
    test::check_refused({"missing scene", {command, path + "/none.toml"}, 3, {"none.toml"}});
    test::check_refused({"folder", {command, path}, 3, {"folder"}});
    test::check_refused({"device", {command, "/dev/zero"}, 3, {"/dev/zero"}});
    test::check_refused({"deep nesting", {command, path + "/nest.toml"}, 2, {"nest.toml"}});
    test::check_refused({"mesh", {command, path + "/mesh.obj"}, 2, {"mesh.obj"}});
    test::check_refused({"name that no system allows", {command, std::string(5000, 'a')}, 3, {"scene file"}});
  }
}

TEST_CASE("A simulation that cannot hold ends with the frame, the reason and what to do") {
  test::TempFolder folder;
  const auto scene = folder.write("scene.toml", test::hanging_cloth());
  const test::RunResult result =
      test::run({"render", scene.string(), "-o", (folder / "out").string(), "--set", "time.integrator=symplectic-euler",
                 "--set", "cloth.sheet.springs.structural=1e9", "--force"});
  INFO(result.err);
  CHECK(result.code == 4);
  CHECK(test::contains(result.err, "frame"));
  CHECK(test::contains(result.err, "substeps"));
  CHECK(test::contains(result.err, "implicit-euler"));
  CHECK(test::pictures_in(folder / "out").empty());
  test::check_only_whole_files(folder.path());
}
