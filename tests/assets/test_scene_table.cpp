// What holds for every key, run over the table itself: a key that is added is tested by being added.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>

#include "assets/scene_canonical.h"
#include "assets/scene_reference.h"
#include "assets/scene_table.h"
#include "test_scene_help.h"

namespace softreel::assets {

namespace {

// A scene file in which one key is given: where it stands, and how messages call it.
struct OneKey {
  std::string text;
  int line = 0, column = 0;
  std::string label;
};

OneKey one_key(const std::string& path, const std::string& value) {
  OneKey one;
  std::string prefix;
  size_t begin = 0;
  for (size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1) {
    prefix = path.substr(0, dot);
    const bool list = find_key(prefix)->kind == KeyInfo::Kind::kList;
    one.text += list ? "[[" + prefix + "]]\n" : "[" + prefix + "]\n";
    one.label += path.substr(begin, dot - begin) + (list ? ".1." : ".");
    ++one.line;
  }
  const std::string name = path.substr(begin);
  one.label += name;
  one.line += 1;
  one.column = static_cast<int>(name.size()) + 4;
  one.text += name + " = " + value + "\n";
  if (!path.starts_with("soft")) one.text += "[[soft]]\nblock = {}\n";
  return one;
}

// Whether the value is refused as such. (A rule about other keys may still refuse the file: not asked here.)
bool refused(const OneKey& one, bool at_the_value) {
  for (const Problem& problem : problems_of(one.text)) {
    const bool about_it = problem.message.starts_with(one.label + ": found") && contains(problem.message, "expected");
    if (about_it && problem.file == kScene && problem.line == one.line &&
        (!at_the_value || problem.column == one.column))
      return true;
  }
  return false;
}

// Numbers that a key takes: how many, and within what range.
struct NumberKey {
  std::string path;
  Range range;
  size_t count;  // 0: one, not in brackets
  bool corners;  // of a box
};

class NumberKeys : public KeyVisitor {
 public:
  std::vector<NumberKey> keys;

  void key(const Key& key, const ValueRef& value) override {
    const auto add = [&](size_t count, bool corners = false) {
      keys.push_back({prefix_ + key.name, key.range, count, corners});
    };
    if (std::holds_alternative<double*>(value) || std::holds_alternative<std::optional<double>*>(value) ||
        std::holds_alternative<int*>(value) || std::holds_alternative<ScaleRef>(value) ||
        std::holds_alternative<UnitRef>(value))
      add(0);
    if (std::holds_alternative<std::vector<double>*>(value)) add(0);
    if (std::holds_alternative<std::vector<int>*>(value) || std::holds_alternative<std::vector<double>*>(value)) add(1);
    if (std::holds_alternative<std::vector<std::array<int, 2>>*>(value)) add(2, true);
    if (std::holds_alternative<std::vector<Vec3>*>(value)) add(3, true);
    if (std::holds_alternative<std::array<double, 2>*>(value) || std::holds_alternative<std::array<int, 2>*>(value))
      add(2);
    if (std::holds_alternative<Vec3*>(value) || std::holds_alternative<std::optional<Vec3>*>(value) ||
        std::holds_alternative<std::array<int, 3>*>(value) || std::holds_alternative<ScaleRef>(value) ||
        std::holds_alternative<Color*>(value) || std::holds_alternative<std::optional<Color>*>(value))
      add(3);
    if (std::holds_alternative<std::optional<Box>*>(value)) add(3, true);
  }
  void section(const Section& section, const SectionRef& ref) override { inside(section, ref.keys); }
  void list(const Section& section, const ListRef& ref) override {
    inside(section, [&](KeyVisitor& v) { ref.keys(ref.size, v); });
  }

 private:
  void inside(const Section& section, const KeyWalk& keys_of_it) {
    const std::string outer = prefix_;
    prefix_ += std::string(section.name) + ".";
    keys_of_it(*this);
    prefix_ = outer;
  }
  std::string prefix_;
};

std::string numbers_text(const NumberKey& key, const std::string& number) {
  if (key.count == 0) return number;
  std::string array = "[";
  for (size_t i = 0; i < key.count; ++i) array += (i > 0 ? ", " : "") + number;
  array += "]";
  return key.corners ? "[" + array + ", " + array + "]" : array;
}

}  // namespace

TEST_CASE("no key is in the table twice, and every one says what it is") {
  std::set<std::string> paths;
  for (const KeyInfo& key : scene_keys()) {
    CAPTURE(key.path);
    CHECK(paths.insert(key.path).second);
    CHECK(!key.help.empty());
    CHECK(!key.type.empty());
    CHECK(!(key.physics && key.picture));
    for (const std::string& bare : key.bare) CHECK(find_key(key.path + "." + bare));
  }
  CHECK(paths.size() > 100);
}

TEST_CASE("every key refuses a value of another type, at its line and column") {
  for (const KeyInfo& key : scene_keys()) {
    CAPTURE(key.path);
    const bool takes_table = key.kind == KeyInfo::Kind::kSection;
    CHECK(refused(one_key(key.path, takes_table ? "2020-01-01" : "{}"), true));
    if (key.kind == KeyInfo::Kind::kValue) CHECK(refused(one_key(key.path, "2020-01-01"), true));
    if (!contains(key.type, "text") && !contains(key.type, "name")) CHECK(refused(one_key(key.path, "'qqqq'"), true));
  }
}

TEST_CASE("every number refuses what lies outside of its range, infinity and what is no number") {
  NumberKeys visitor;
  Scene scene;
  walk_scene(visitor, scene);
  CHECK(visitor.keys.size() > 80);
  for (const NumberKey& key : visitor.keys) {
    CAPTURE(key.path);
    const bool one = key.count == 0;
    for (const char* number : {"nan", "inf", "-inf", "1e300", "-1e300"})
      CHECK_MESSAGE(refused(one_key(key.path, numbers_text(key, number)), one), number);
    for (double beyond : {key.range.lo - 1, key.range.hi + 1, key.range.hi * 1.01 + 1})
      CHECK_MESSAGE(refused(one_key(key.path, numbers_text(key, fmt::format("{}", beyond))), one), beyond);
    if (key.range.open_lo) CHECK(refused(one_key(key.path, numbers_text(key, fmt::format("{}", key.range.lo))), one));
    if (key.range.open_hi) CHECK(refused(one_key(key.path, numbers_text(key, fmt::format("{}", key.range.hi))), one));
  }
}

TEST_CASE("every key takes its default and every name that it can choose") {
  for (const KeyInfo& key : scene_keys()) {
    CAPTURE(key.path);
    if (!key.default_text.empty() && key.path != "soft.pins.vertices")
      CHECK_MESSAGE(!refused(one_key(key.path, key.default_text), false), key.default_text);
    for (const std::string& name : key.choices)
      CHECK_MESSAGE(!refused(one_key(key.path, "'" + name + "'"), false), name);
  }
}

TEST_CASE("every key can be set from the command line") {
  for (const KeyInfo& key : scene_keys()) {
    if (key.kind != KeyInfo::Kind::kValue) continue;
    CAPTURE(key.path);
    // The key is in the file already, so that lists have an entry; the override replaces it.
    const OneKey one = one_key(key.path, key.default_text.empty() ? "{}" : key.default_text);
    const std::string set = one.label + "=2020-01-01";
    const std::string report = report_of(one.text, {set});
    CHECK_MESSAGE(contains(report, "--set " + set + ": " + one.label + ": found a date or time"), report);
  }
}

TEST_CASE("the reference names every key, section and choice") {
  const std::string reference = scene_reference_markdown();
  const std::string choices = scene_choices_text();
  for (const KeyInfo& key : scene_keys()) {
    CAPTURE(key.path);
    if (key.kind == KeyInfo::Kind::kValue) CHECK(contains(reference, fmt::format("| `{}` |", key.name())));
    if (key.kind == KeyInfo::Kind::kSection) CHECK(contains(reference, "[" + key.path + "]"));
    if (key.kind == KeyInfo::Kind::kList) CHECK(contains(reference, "[[" + key.path + "]]"));
    for (const std::string& name : key.choices) CHECK(contains(choices, name));
  }
}

}  // namespace softreel::assets
