#include "assets/formula.h"

#include <doctest/doctest.h>

#include <cmath>

#include "test_scene_help.h"

namespace softreel::assets {

TEST_CASE("a formula is what it says in x, y, z and t") {
  const sim::Vec3 p(1, 2, 3);
  CHECK(Formula("sin(pi*x/2)*exp(-t)")(p, 0.5) == std::exp(-0.5));
  CHECK(Formula("-2^2")(p, 0) == -4);
  CHECK(Formula("x < y && z >= 3 ? 7 : 8")(p, 0) == 7);
  CHECK(Formula("t < 1 ? 1 : t < 2 ? 2 :\n t < 3 ? 3 : 4")(p, 2.5) == 3);
  CHECK(Formula("atan2(y, x) + min(1, 2, 3) + ln(e)")(p, 0) == std::atan2(2.0, 1.0) + 2);
  CHECK(Formula("1e-3*z")(p, 0) == 3e-3);
  CHECK(Formula("x*t").uses_time());
  CHECK_FALSE(Formula("tan(x)").uses_time());
  CHECK(Formula("0").is_zero());
  CHECK_FALSE(Formula("0*x").is_zero());
  const Formula one("x"), copy = one;
  CHECK(copy(p, 0) == 1);
}

TEST_CASE("a mistake in a formula is told with its place") {
  struct Wrong {
    const char* text;
    const char* says;
  };
  for (const Wrong& wrong : {Wrong{"qqqq", "at character 1: \"qqqq\" is unknown"},
                             {"sin(x", "at character 6: a bracket is never closed"},
                             {"sin(x))", "at character 7: \")\" does not belong here"},
                             {"1+", "at character 3: it ends too early"},
                             {"2x", "at character 2: Unexpected variable \"x\""},
                             {"x = 3", "at character 3: \"=\" does not belong here; to compare, write =="},
                             {"1, 2", "2 values separated by commas"},
                             {"", "Expression is empty"},
                             {"sin()", "Too few parameters for function \"sin\""},
                             {"x # 2", "at character 3: \"#"},
                             {"\"x\"", "at character 1: this sign means nothing"},
                             {"2·x", "at character 2: this sign means nothing"}}) {
    CAPTURE(wrong.text);
    const auto fault = formula_fault(wrong.text);
    REQUIRE(fault);
    CHECK_MESSAGE(contains(*fault, wrong.says), *fault);
    CHECK_FALSE(contains(*fault, "position"));
  }
  CHECK(formula_fault(std::string(5000, '1')));
  CHECK_FALSE(formula_fault(std::string(900, '(') + "1" + std::string(900, ')')));
}

TEST_CASE("every function that the help names is there") {
  std::string text = formula_help();
  text = text.substr(text.find("sin"));
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(", ", begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    CAPTURE(name);
    CHECK_FALSE(formula_fault(name + (name == "atan2" ? "(1, 2)" : "(0.5)")));
    begin = end + 2;
  }
}

TEST_CASE("a field is read as it is written") {
  const Scene scene = parse(R"toml(
[time]
integrator = "rk4"
[[field]]
equation = "heat"
grid = { size = [2, 1], cells = [20, 10] }
diffusivity = 0.1
source = "x*t"
initial = 20
fixed = [{ boundary = true, value = 1.5 }, { box = [[0, 0, 0], [1, 1, 1]], value = "sin(t)" }]
height = 0.5
colormap = "inferno"
range = [0, 100]
label = "temperature"
[[field]]
name = "skin"
mesh = "skin.obj"
fixed = [{ boundary = true }]
colorbar = false
)toml");
  REQUIRE(scene.fields.size() == 2);
  const Field& heat = scene.fields[0];
  CHECK(heat.name == "field-1");
  CHECK(heat.equation == "heat");
  CHECK(heat.diffusivity == 0.1);
  CHECK(heat.source == "x*t");
  CHECK(heat.initial == "20");
  REQUIRE(heat.fixed.size() == 2);
  CHECK(heat.fixed[0].boundary);
  CHECK(heat.fixed[0].value == "1.5");
  CHECK(heat.fixed[1].box);
  CHECK(heat.fixed[1].value == "sin(t)");
  CHECK(heat.colormap == ColorMap::kInferno);
  CHECK((*heat.range)[1] == 100);
  CHECK(heat.colorbar);
  const Field& skin = scene.fields[1];
  CHECK(skin.equation == "poisson");
  CHECK(skin.fixed[0].value == "0");
  CHECK(!skin.range);
  CHECK(!skin.colorbar);
  CHECK(scene.soft.empty());
  CHECK(scene.assets.size() == 1);
  CHECK(scene.assets[0].physics);
  CHECK(parse("[[field]]\ngrid = {}\nfixed = [{ boundary = true }]\n", {"field.field-1.source=sin(x)"})
            .fields[0]
            .source == "sin(x)");
}

TEST_CASE("a mistake in a field is reported where it stands") {
  struct Wrong {
    const char* text;
    int line, column;
    const char* says;
  };
  const Wrong wrongs[] = {
      {"[[field]]\nequation = 'heat'", 1, 0, "has no shape; add mesh = \"FILE\" or grid"},
      {"[[field]]\ngrid = {}", 1, 0, "poisson needs a value somewhere"},
      {"[[field]]\nequation = 'heet'\ngrid = {}\nfixed = [{ boundary = true }]", 2, 12, "did you mean \"heat\"?"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\nsource = 'sin(q)'", 4, 10, "at character 5: \"q\" is unknown"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\nsource = true", 4, 10, "a formula in x, y, z, t"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\nspeed = 2", 4, 9, "is for equation = \"wave\""},
      {"[[field]]\nequation = 'wave'\ngrid = {}\ndiffusivity = 2", 4, 15, "is for equation = \"heat\""},
      {"[[field]]\ngrid = {}\nfixed = [{ boundary = true }]\ninitial = 2", 4, 11, "poisson has no time of its own"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\nfixed = [{ value = 1 }]", 4, 10, "add boundary = true or box"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\nrange = [1, 1]", 4, 9, "expected [lowest, highest]"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\nrange = 1", 4, 9, "two numbers [lowest, highest]"},
      {"[[field]]\nequation = 'heat'\ngrid = {}\ncolormap = 'jet'", 4, 12, "\"viridis\""},
      {"[[field]]\nequation = 'heat'\ngrid = {}\ncolorbar = false\nlabel = 'u'", 5, 9, "colorbar is false"},
      {"[time]\nintegrator = 'verlet'\n[[field]]\nequation = 'heat'\ngrid = {}", 2, 14, "cannot step field 1"},
      {"[time]\nintegrator = 'static'\n[[field]]\nequation = 'wave'\ngrid = {}", 2, 14, "cannot step field 1"},
      {"[[field]]\nname = 'a'\nequation = 'heat'\ngrid = {}\n[[cloth]]\nname = 'a'\ngrid = {}", 2, 0, "already"},
  };
  for (const Wrong& wrong : wrongs) {
    CAPTURE(wrong.text);
    const std::vector<Problem> problems = problems_of(wrong.text);
    REQUIRE(problems.size() == 1);
    CHECK_MESSAGE(contains(problems[0].message, wrong.says), problems[0].message);
    CHECK(problems[0].line == wrong.line);
    if (wrong.column > 0) CHECK(problems[0].column == wrong.column);
  }
}

}  // namespace softreel::assets
