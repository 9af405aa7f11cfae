// Broken scene files end in an error or a scene, whatever is in them.
#include <doctest/doctest.h>

#include <random>

#include "test_scene_help.h"

namespace softreel::assets {

namespace {

const std::string kText = R"(title = "all of it"
gravity = [0, -9.81, 0]
light = [{ kind = "sun", angle = 3 }, {}]
[time]
fps = 24
[[soft]]
name = "a"
block = { size = [1, 1, 1], cells = [2, 2, 2] }
material = { preset = "rubber", young = 1e5 }
pins = [{ box = [[0, 0, 0], [1, 1, 1]], motion = [{ t = 0 }, { t = 1, rotate = [0, 90, 0] }] }]
look = { color = "#d9a066" }
[[cloth]]
grid = { cells = [4, 4] }
model = "mass-spring"
springs = { structural = 1e3 }
[[collider]]
shape = "capsule"
motion = [{ t = 0 }, { t = 2, translate = [1, 0, 0] }]
[render]
background = { top = "sky", bottom = [1, 1, 1] }
)";

// Reads it as a scene; anything but a UserError would end the test.
void survive(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const UserError& error) {
    REQUIRE(!error.problems().empty());
    for (const Problem& problem : error.problems()) REQUIRE(!problem.message.empty());
  }
}

}  // namespace

TEST_CASE("a scene file that is cut off anywhere is read or refused") {
  REQUIRE(problems_of(kText).empty());
  for (size_t length = 0; length < kText.size(); ++length) survive(kText.substr(0, length));
}

TEST_CASE("a scene file with any byte changed is read or refused") {
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    std::string text = kText;
    for (unsigned n = 1 + random() % 4; n > 0; --n) text[random() % text.size()] = static_cast<char>(random());
    survive(text);
  }
}

TEST_CASE("lines of scene files in any order are read or refused") {
  std::vector<std::string> lines(1);
  for (char c : kText) {
    lines.back() += c;
    if (c == '\n') lines.emplace_back();
  }
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    std::string text;
    for (int n = 0; n < 20; ++n) text += lines[random() % lines.size()];
    survive(text);
  }
}

TEST_CASE("random bytes are refused") {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string text(random() % 500, '\0');
    for (char& c : text) c = static_cast<char>(random());
    survive(text);
    survive(kText, {text});
    survive(kText, {"title=" + text});
  }
}

TEST_CASE("deep nesting is refused") {
  survive("title = " + std::string(100000, '['));
  std::string tables = "soft = ";
  for (int i = 0; i < 5000; ++i) tables += "[{ pins = ";
  survive(tables);
  std::string path = "soft";
  for (int i = 0; i < 20000; ++i) path += ".pins";
  CHECK(contains(report_of(path + " = 1"), "a key of more than 17 parts"));
  std::string quoted = "soft";
  for (int i = 0; i < 20000; ++i) quoted += i % 2 ? ".\"=\\\"\"" : ".'#\"'";
  CHECK(contains(report_of("# '\n" + quoted + " = 1"), "a key of more than 17 parts"));
  survive(path + " = 1");
  survive("[" + path + "]");
  std::string mixed;
  for (int i = 0; i < 250; ++i) mixed += "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = {";
  survive(mixed + std::string(250, '}'));
  survive(kText, {path + "=1"});
  survive(kText, {"title=" + std::string(100000, '[')});
}

TEST_CASE("dots in texts, comments and numbers are no deep keys") {
  const std::string dots(300, '.');
  CHECK(report_of("# " + dots + "\ntitle = '" + dots + "'\n[[soft]]\nblock = {}").empty());
  CHECK(report_of("title = \"\"\"\n\\\"\"\"" + dots + "\n\"\"\"\n[[soft]]\nblock = {}").empty());
}

}  // namespace softreel::assets
