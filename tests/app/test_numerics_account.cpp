// sim/NUMERICS.md against the program: what it names exists, and what exists it names.
#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/method_list.h"
#include "assets/scene_reference.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

std::string source_text(const std::string& file) {
  std::ifstream in(std::string(SOFTREEL_SOURCE_DIR) + "/" + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string trimmed(const std::string& s) {
  const auto first = s.find_first_not_of(' ');
  return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(' ') - first + 1);
}

/// What stands between backticks.
std::vector<std::string> code_in(const std::string& line) {
  std::vector<std::string> all;
  static const std::regex kCode("`([^`]*)`");
  for (std::sregex_iterator m(line.begin(), line.end(), kCode), end; m != end; ++m) all.push_back((*m)[1]);
  return all;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

/// A table under a heading that names a key of the scene; its rows by the name in their first column.
struct Table {
  std::string key;
  std::vector<std::string> header;
  std::map<std::string, std::vector<std::string>> rows;

  std::string cell(const std::string& name, const std::string& column) const {
    const auto at = std::find(header.begin(), header.end(), column) - header.begin();
    const auto row = rows.find(name);
    if (row == rows.end() || at >= static_cast<std::ptrdiff_t>(row->second.size())) return {};
    return row->second[static_cast<size_t>(at)];
  }
};

/// The tables whose first column is "name".
std::vector<Table> tables_of_account() {
  std::vector<Table> tables;
  std::vector<std::string> keys;
  std::istringstream in(source_text("sim/NUMERICS.md"));
  bool inside = false, names = false, code = false;
  size_t first = 0;  // of the tables that are being filled: one for each key of the heading
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("```", 0) == 0) code = !code;
    if (code) continue;
    if (line.rfind("#", 0) == 0) keys = code_in(line);
    const bool row = line.rfind("|", 0) == 0, head = row && !inside;
    inside = row;
    if (!row || line.rfind("|-", 0) == 0) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (head) {
      names = cells.front() == "name";
      first = tables.size();
      if (names)
        for (const std::string& key : keys) tables.push_back({key, cells, {}});
      CHECK_MESSAGE((!names || !keys.empty()), "sim/NUMERICS.md: names under a heading without a key: " << line);
    } else if (names) {
      const std::vector<std::string> name = code_in(cells.front());
      CHECK_MESSAGE(name.size() == 1, "sim/NUMERICS.md: a row without a name in its first column: " << line);
      for (size_t t = first; t < tables.size() && name.size() == 1; ++t) tables[t].rows[name.front()] = cells;
    }
  }
  return tables;
}

/// Keys whose choices are numerics, beside those of method_groups().
const std::vector<std::string> kOtherKeys = {"cloth.model",    "cloth.bending_model", "cloth.mass", "soft.mass",
                                             "collider.shape", "field.equation",      "field.mass"};

/// Key and the names that it can take.
std::map<std::string, std::set<std::string>> names_of_program() {
  std::map<std::string, std::set<std::string>> names;
  for (const app::MethodGroup& group : app::method_groups())
    for (const sim::MethodInfo& m : group.methods) names[group.key].insert(std::string(m.name));
  for (const std::string& key : kOtherKeys)
    if (const assets::KeyInfo* info = assets::find_key(key); info && !info->choices.empty())
      names[key].insert(info->choices.begin(), info->choices.end());
  return names;
}

}  // namespace

TEST_CASE("sim/NUMERICS.md names every method that a scene can choose, and none that there is not") {
  const auto names = names_of_program();
  std::set<std::string> told;
  for (const Table& table : tables_of_account()) {
    told.insert(table.key);
    const auto known = names.find(table.key);
    CHECK_MESSAGE(known != names.end(),
                  "sim/NUMERICS.md has a table of `" << table.key << "`, which is no such key of a scene");
    if (known == names.end()) continue;
    for (const auto& [name, cells] : table.rows)
      CHECK_MESSAGE(known->second.count(name) == 1,
                    "sim/NUMERICS.md names `" << name << "` under `" << table.key << "`; the program has none");
    for (const std::string& name : known->second)
      CHECK_MESSAGE(table.rows.count(name) == 1, "the program has " << table.key << " = \"" << name
                                                                    << "\"; sim/NUMERICS.md has no row for it there");
  }
  for (const auto& [key, choices] : names)
    CHECK_MESSAGE(told.count(key) == 1, "a scene can choose "
                                            << key << "; sim/NUMERICS.md has no table under a heading with `" << key
                                            << "`");
}

TEST_CASE("sim/NUMERICS.md has the order of every integrator") {
  for (const Table& table : tables_of_account()) {
    if (table.key != "time.integrator") continue;
    for (const sim::MethodInfo& m : sim::integrators()) {
      const std::string name(m.name), order = m.order > 0 ? std::to_string(m.order) : "none";
      CHECK_MESSAGE(table.cell(name, "order") == order, "sim/NUMERICS.md: order of `" << name << "` is " << order);
    }
  }
}

// A line that names a test file quotes test cases of that file.
TEST_CASE("the tests that sim/NUMERICS.md refers to exist") {
  static const std::regex kQuoted("\"([^\"]*)\"");
  std::istringstream in(source_text("sim/NUMERICS.md"));
  int cases = 0;
  for (std::string line; std::getline(in, line);) {
    std::string tests;
    for (const std::string& code : code_in(line)) {
      if (code.rfind("tests/", 0) != 0) continue;
      const std::string text = source_text(code);
      CHECK_MESSAGE(!text.empty(), "sim/NUMERICS.md refers to " << code << ", which there is not");
      tests += text;
    }
    if (tests.empty()) continue;
    for (std::sregex_iterator m(line.begin(), line.end(), kQuoted), end; m != end; ++m, ++cases)
      CHECK_MESSAGE(tests.find((*m)[0].str()) != std::string::npos,
                    "sim/NUMERICS.md refers to the test case " << (*m)[0].str() << ", which is not where it says");
  }
  CHECK(cases > 50);
}

TEST_CASE("check --list tells of every method its name, order, cost and source") {
  const test::RunResult result = test::run({"check", "--list"});
  REQUIRE(result.code == 0);
  std::set<std::string> keys;
  for (const app::MethodGroup& group : app::method_groups()) {
    const std::string key = group.key, title = std::string(group.title) + " (" + key + ")\n";
    CHECK_MESSAGE(keys.insert(key).second, "the list has " << key << " twice");
    CHECK_MESSAGE(assets::find_key(key) != nullptr, "the list has " << key << ", which is no key of a scene");
    const auto start = result.out.find(title);
    CHECK_MESSAGE(start != std::string::npos, "softreel check --list has no paragraph '" << title << "'");
    if (start == std::string::npos) continue;
    const std::string paragraph = result.out.substr(start, result.out.find("\n\n", start) - start) + "\n";
    CHECK(!group.methods.empty());
    for (const sim::MethodInfo& m : group.methods) {
      const std::string name(m.name), help(m.help), cost(m.cost), source(m.source);
      CHECK_MESSAGE(!help.empty(), key << " = " << name << " has no help");
      CHECK_MESSAGE(!cost.empty(), key << " = " << name << " has no cost");
      // What only chooses, or does nothing, comes from nowhere.
      CHECK_MESSAGE((!source.empty() || name == "auto" || name == "none"), key << " = " << name << " has no source");
      const auto at = paragraph.find("\n  " + name + " ");
      CHECK_MESSAGE(at != std::string::npos, "softreel check --list does not name " << key << " = " << name);
      if (at == std::string::npos) continue;
      const auto end = paragraph.find('\n', paragraph.find('\n', at + 1) + 1);  // of two lines
      const std::string entry = paragraph.substr(at, end - at);
      const std::string order = m.order > 0 ? "order " + std::to_string(m.order) + "; " : "";
      for (const std::string& part : {order + help, "cost: " + cost, source.empty() ? "" : "source: " + source})
        CHECK_MESSAGE(test::contains(entry, part), "softreel check --list: " << name << " without '" << part << "'");
    }
  }
}
