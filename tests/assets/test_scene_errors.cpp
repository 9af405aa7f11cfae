#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>

#include "assets/scene_nearest.h"
#include "test_scene_help.h"

namespace softreel::assets {

namespace {

struct Wrong {
  const char* text;
  int line, column;                 // of the problem; 0: the file as a whole
  std::array<const char*, 3> says;  // parts of its message
};

const std::string kBody = "\n[[soft]]\nblock = {}\n";  // so that nothing but the mistake is wrong

}  // namespace

TEST_CASE("a mistake in the file is reported where it stands, with what is allowed") {
  const Wrong wrongs[] = {
      // Text that is no TOML.
      {"fps = = 30", 1, 7, {"not valid TOML"}},
      {"title = \"open", 1, 0, {"not valid TOML"}},
      {"title = \"a\"\ntitle = \"b\"", 2, 0, {"not valid TOML"}},
      {"title = \"\xff\"", 1, 0, {"not valid TOML"}},
      {"camera = { fov = 40,\n up = [0, 1, 0] }", 1, 0, {"not valid TOML", "has to stay on one line"}},
      // Keys and sections that do not exist.
      {"titel = 'x'", 1, 1, {"unknown", "\"titel\"", "did you mean \"title\"?"}},
      {"fps = 30", 1, 1, {"unknown", "\"fps\"", "belongs in [time]"}},
      {"[rendr]\nsamples = 4", 1, 2, {"unknown", "\"rendr\"", "did you mean \"render\"?"}},
      {"[[colider]]", 1, 3, {"unknown", "did you mean \"collider\"?"}},
      {"[camera]\nfoc = 40", 2, 1, {"\"foc\" in [camera]", "did you mean \"fov\"?"}},
      {"[contact]\nselfish = true", 2, 1, {"\"selfish\"", "self"}},
      {"[[soft]]\nblock = {}\nyoung = 1e5", 3, 1, {"\"young\" in [[soft]]", "belongs in [soft.material]"}},
      {"[[soft]]\nblock = { sise = [1, 1, 1] }", 2, 11, {"\"sise\"", "did you mean \"size\"?"}},
      // Values of the wrong type.
      {"gravity = -9.81", 1, 11, {"gravity: found -9.81", "three numbers [x, y, z] [m/s^2]"}},
      {"gravity = [0, -9.81]", 1, 11, {"found an array of 2", "three numbers"}},
      {"gravity = [0, 'down', 0]", 1, 15, {"gravity: found the string \"down\""}},
      {"title = 5", 1, 9, {"title: found 5", "a text in quotes"}},
      {"time = 3", 1, 8, {"time: found 3", "expected a table", "[time]"}},
      {"[soft]\nblock = {}", 1, 0, {"soft: found a table", "write [[soft]]"}},
      {"[[soft]]\nblock = 5", 2, 9, {"soft.1.block: found 5", "expected a table"}},
      {"[time]\nsubsteps = 2.5", 2, 12, {"time.substeps: found 2.5", "a whole number"}},
      {"[time]\nfps = 2020-01-01", 2, 7, {"found a date or time"}},
      {"[[soft]]\nblock = {}\nvisible = 1", 3, 11, {"soft.1.visible: found 1", "true or false"}},
      {"[[soft]]\nblock = {}\npins = 3", 3, 8, {"expected a list of tables"}},
      {"[[soft]]\nblock = {}\npins = [3]", 3, 9, {"soft.1.pins.1: found 3", "expected a table"}},
      // Names that cannot be chosen.
      {"[time]\nintegrator = 'implicit-eulr'", 2, 14, {"did you mean \"implicit-euler\"?"}},
      {"[solver]\nlinear = 'gmress'", 2, 10, {"did you mean \"gmres\"?"}},
      {"[solver]\nlinear = 'cg'\npreconditioner = 'ilu'", 3, 18, {"one of \"none\", \"jacobi\", \"block-jacobi\""}},
      {"[solver]\nlinear = 'sor'\nomega = 2", 3, 9, {"found 2", "below 2"}},
      {"[solver]\nlinear = 'cg'\nomega = 1.2", 3, 9, {"is for linear = \"sor\""}},
      {"[solver]\npreconditioner = 'multigrid'", 2, 18, {"is for linear = \"cg\", \"gmres\""}},
      {"[solver]\nlinear = 'cg'\nrestart = 20", 3, 11, {"is for linear = \"gmres\""}},
      {"[solver]\nlinear = 'lu'\nlinear_max_iterations = 20", 3, 25, {"is for a linear solver that iterates"}},
      {"[[soft]]\nblock = {}\nmaterial = 'ruber'", 3, 12, {"soft.1.material: found", "did you mean \"rubber\"?"}},
      {"[[soft]]\nblock = {}\nmaterial = { model = 'neo-hookean' }", 3, 22, {"did you mean \"stable-neo-hookean\"?"}},
      {"[[soft]]\nblock = {}\nlook = 'gren'", 3, 8, {"soft.1.look: found", "a colour", "did you mean \"grey\"?"}},
      {"[[soft]]\nblock = {}\nlook = { color = '#12345' }", 3, 18, {"look.color: found", "#rrggbb"}},
      {"[[soft]]\nmesh = 'a.obj'\nunit = 'inch'", 3, 8, {"one of \"m\", \"cm\", \"mm\""}},
      {"[[soft]]\nblock = {}\npins = [{ box = [[0,0,0],[1,1,1]], axes = 'xw' }]", 3, 43, {"a text of x, y and z"}},
      {"[[soft]]\nblock = {}\nname = 'a.b'", 3, 8, {"a name in quotes, without ."}},
      // Numbers that cannot hold.
      {"[time]\nduration = 0", 2, 12, {"time.duration: found 0", "above 0"}},
      {"[time]\nduration = nan", 2, 12, {"found nan"}},
      {"[time]\nduration = -inf", 2, 12, {"found -inf"}},
      {"[time]\nfps = 0", 2, 7, {"time.fps: found 0"}},
      {"[time]\nsubsteps = 1000000000", 2, 12, {"1 to 1000000"}},
      {"[time]\nduration = 1e6\nfps = 1000", 2, 12, {"1000000000 frames, at most 1000000"}},
      {"[time]\nduration = 3e4\nsubsteps = 1000000", 3, 12, {"900000000000 steps, at most"}},
      {"[[soft]]\nblock = {}\ndensity = -1", 3, 11, {"soft.1.density: found -1", "[kg/m^3]"}},
      {"[[soft]]\nblock = {}\nmaterial = { poisson = 0.5 }", 3, 24, {"below 0.5", "incompressible"}},
      {"[[soft]]\nblock = {}\nscale = [1, 0, 1]", 3, 13, {"soft.1.scale: found 0", "above 0"}},
      {"[[soft]]\nblock = { cells = [1000000000, 1, 1] }", 2, 20, {"found 1000000000", "each 1 to 4096"}},
      {"[[soft]]\nblock = { cells = [4096, 4096, 4096] }", 2, 19, {"tetrahedra, at most 8000000"}},
      {"[[cloth]]\ngrid = { cells = [4096, 4096] }", 2, 18, {"33554432 triangles, at most 8000000"}},
      {"[render]\nsize = [100000, 720]", 2, 9, {"render.size: found 100000", "each 1 to 8192"}},
      {"[render]\nsamples = 1e9", 2, 11, {"render.samples: found", "1 to 4096"}},
      {"[render]\nseed = 99999999999999999999", 2, 0, {"not valid TOML"}},
      {"[camera]\nfov = 180", 2, 7, {"1 to 150"}},
      // Keys that do not go together.
      {"", 0, 0, {"nothing to simulate", "[[soft]]"}},
      {"[[collider]]", 0, 0, {"nothing to simulate"}},
      {"[[soft]]\nname = 'a'", 1, 1, {"soft.a: has no shape", "mesh ="}},
      {"[[soft]]\nmesh = 'a.obj'\nblock = {}", 3, 9, {"both mesh and block"}},
      {"[[cloth]]\nmesh = 'a.obj'\ngrid = {}", 3, 8, {"both mesh and grid"}},
      {"[[soft]]\nblock = {}\nup = 'z'", 3, 6, {"is for a mesh file"}},
      {"[[soft]]\nblock = {}\ntetrahedralize = {}", 3, 18, {"made of tetrahedra already"}},
      {"[[soft]]\nblock = {}\n[[soft.pins]]\naxes = 'x'", 3, 1, {"soft.1.pins.1: says of no vertices"}},
      {"[[soft]]\nblock = {}\npins = [{ box = [[1, 0, 0], [0, 1, 1]] }]", 3, 17, {"the lower one in x, y and z"}},
      {"[[collider]]\nmotion = [{ t = 1 }, { t = 1 }]"
       "\n[[soft]]\nblock = {}",
       2,
       28,
       {"motion.2.t: found t = 1"}},
      {"[[cloth]]\ngrid = {}\nsprings = { bend = 1 }", 3, 11, {"is for model = \"mass-spring\""}},
      {"[[cloth]]\ngrid = {}\nmodel = 'mass-spring'\nbending_model = 'quadratic'", 4, 17, {"\"membrane\""}},
      {"[[soft]]\nblock = {}\n[[collider]]\nradius = 1", 4, 10, {"is for shape = \"sphere\" or \"capsule\""}},
      {"[[soft]]\nblock = {}\n[[collider]]\nnormal = [0, 0, 0]", 4, 10, {"expected a direction"}},
      {"[[soft]]\nblock = {}\n[[collider]]\nshape = 'sphere'\nscale = [1, 2, 1]", 5, 9, {"has to stay round"}},
      {"[camera]\nposition = [1, 1, 1]\ntarget = [1, 1, 1]", 3, 10, {"look nowhere"}},
      {"[camera]\nposition = [0, 9, 0]\ntarget = [0, 0, 0]", 1, 1, {"camera.up", "no upright"}},
      {"[[light]]\nkind = 'sun'\nradius = 1", 3, 10, {"is for kind = \"area\""}},
      {"[[soft]]\nname = 'a'\nblock = {}\n[[cloth]]\nname = 'a'\ngrid = {}", 5, 8, {"\"a\" is already that of soft.1"}},
  };
  for (const Wrong& wrong : wrongs) {
    const std::string text = wrong.text;
    CAPTURE(text);
    const bool has_body = contains(text, "soft]") || contains(text, "cloth]") || contains(wrong.says[0], "nothing");
    const std::vector<Problem> problems = problems_of(has_body ? text : text + kBody);
    CHECK(problems.size() == 1);
    if (problems.empty()) continue;
    const Problem& problem = problems[0];
    CAPTURE(problem.text());
    CHECK(problem.file == kScene);
    CHECK(problem.line == wrong.line);
    if (wrong.column > 0) CHECK(problem.column == wrong.column);
    for (const char* part : wrong.says)
      if (part) CHECK_MESSAGE(contains(problem.message, part), std::string(part));
  }
}

TEST_CASE("all mistakes of a file are reported at once, from top to bottom") {
  const std::vector<Problem> problems = problems_of("[time]\nfps = 0\nduration = 'long'\n[[soft]]\nmesh = 3\n[cam]\n");
  REQUIRE(problems.size() == 4);
  for (size_t i = 1; i < problems.size(); ++i) CHECK(problems[i - 1].line < problems[i].line);
}

TEST_CASE("a file that is wrong a thousand times is reported in a hundred lines") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += fmt::format("x{} = 1\n", i);
  const std::vector<Problem> problems = problems_of(text);
  CHECK(problems.size() == 101);
  CHECK(contains(problems.back().message, "and 901 more"));
}

TEST_CASE("a long text is cut between letters when it is quoted in a message") {
  std::string text = "[time]\nintegrator = '";
  for (int i = 0; i < 50; ++i) text += "\xc3\xa4";  // a two-byte letter
  text += "x'";
  const std::string report = report_of(text + kBody);
  CHECK(contains(report, "..."));
  CHECK(!contains(report, "\xc3.."));
}

TEST_CASE("a misspelt name finds the name that was meant, and a strange one finds none") {
  CHECK(edit_distance("young", "young") == 0);
  CHECK(edit_distance("yuong", "young") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("Slip-Speed", "slip_speed") == 0);
  CHECK(nearest_name("colider", {"cloth", "collider"}) == "collider");
  CHECK(nearest_name("wind", {"time", "light", "render"}).empty());
  CHECK(nearest_name("", {"a"}).empty());
  CHECK(nearest_name(std::string(100000, 'a'), {"a"}).empty());
}

}  // namespace softreel::assets
