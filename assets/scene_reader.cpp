#include "assets/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "assets/error.h"
#include "assets/scene_nearest.h"
#include "assets/scene_override.h"
#include "assets/scene_unknown.h"
#include "assets/scene_value.h"

namespace softreel::assets {

namespace {

class Reader : public KeyVisitor {
 public:
  Reader(const Node& root, Scene& scene, std::vector<Problem>& problems)
      : scene_(scene), problems_(problems), level_{&root, "", ""} {}

  void read() {
    walk_scene(*this, scene_);
    leave();
    if (scene_.soft.empty() && scene_.cloth.empty() && scene_.springs.empty() && scene_.fields.empty() &&
        !misread_list_)
      problem("",
              "there is nothing to simulate; add a [[soft]], [[cloth]], [[springs]] or [[field]], such as: [[soft]] "
              "block = {}");
  }

  void key(const Key& key, const ValueRef& value) override {
    const Node* node = take(key.name);
    if (!node) return;
    // `material = "rubbr"` is not called material.preset to someone who did not write that.
    const std::string path = level_.bare ? level_.label : label_of(key.name);
    if (const auto fault = read_value(*node, key, value)) report(fault->where, path + ": " + fault->message);
    if (const auto* file = std::get_if<FileRef>(&value); file && !file->path->empty())
      scene_.assets.push_back(
          {path, *file->path, key.role == Role::kPhysics, node->where.file, node->where.line, node->where.column});
  }

  void section(const Section& section, const SectionRef& ref) override {
    const Node* node = take(section.name);
    if (!node) {
      // Its keys are walked nevertheless: some rules hold for defaults too.
      if (ref.present) walk_absent(section.name, ref.keys);
      return;
    }
    const std::string label = label_of(section.name);
    const Node table = expand_bare(*node, {section.bare.begin(), section.bare.end()});
    if (!table.is_table())
      return report(node->where, fmt::format("{}: found {}, expected a table such as [{}] or {} = {{ ... }}", label,
                                             node->found(), label, section.name));
    ref.create();
    enter({&table, label, path_of(section.name), {}, !node->is_table()}, ref.keys);
  }

  void list(const Section& section, const ListRef& ref) override {
    const Node* node = take(section.name);
    if (!node) return;
    const std::string label = label_of(section.name);
    if (!node->is_array()) {
      misread_list_ = true;
      return report(node->where, fmt::format("{}: found {}, expected a list of tables; write [[{}]]", label,
                                             node->found(), path_of(section.name)));
    }
    for (size_t i = 0; i < node->children.size(); ++i) {
      const Node& entry = node->children[i];
      if (!entry.is_table()) {
        misread_list_ = true;
        report(entry.where, fmt::format("{}.{}: found {}, expected a table", label, i + 1, entry.found()));
        continue;
      }
      ref.append();
      enter({&entry, label + "." + entry_label(entry, i), path_of(section.name)}, ref.last);
    }
  }

  bool reading() const override { return true; }

  bool given(std::string_view path) const override { return resolve(path).second; }

  void problem(std::string_view path, std::string message) override {
    const auto [node, complete] = resolve(path);
    const std::string label = path.empty() ? level_.label : label_of(path);
    report(node->where, label.empty() ? message : label + ": " + message);
  }

  void note(std::string_view path, std::string message) override {
    const Where& where = resolve(path).first->where;
    const std::string place =
        where.line > 0 ? fmt::format("{}:{}:{}", where.file, where.line, where.column) : where.file;
    scene_.notes.push_back(fmt::format("{}: {}: {}", place, label_of(path), message));
  }

 private:
  struct Level {
    const Node* table;
    std::string label;  ///< "soft.spot.material": for messages
    std::string path;   ///< "soft.material": in the reference
    std::vector<std::string_view> known = {};
    bool bare = false;  ///< a bare value stood for the table
  };

  static std::string entry_label(const Node& entry, size_t i) {
    const Node* name = entry.find("name");
    return name && name->kind == Node::Kind::kString && !name->text.empty() ? name->text : std::to_string(i + 1);
  }

  static std::string joined(const std::string& a, std::string_view b) {
    return a.empty() ? std::string(b) : fmt::format("{}.{}", a, b);
  }
  std::string label_of(std::string_view name) const { return joined(level_.label, name); }
  std::string path_of(std::string_view name) const { return joined(level_.path, name); }

  const Node* take(std::string_view name) {
    level_.known.push_back(name);
    return level_.table->find(name);
  }

  void enter(Level level, const KeyWalk& keys) {
    std::swap(level, level_);
    keys(*this);
    leave();
    std::swap(level, level_);
  }

  void walk_absent(std::string_view name, const KeyWalk& keys) {
    Node empty;
    empty.where = level_.table->where;
    enter({&empty, label_of(name), path_of(name)}, keys);
  }

  // Reports the keys of the table that nobody has asked for.
  void leave() {
    for (const Node& child : level_.table->children) {
      if (std::find(level_.known.begin(), level_.known.end(), child.key) == level_.known.end())
        report(child.key_where, unknown_key_text(level_.path, child.key));
    }
  }

  // The node at a path from here, or the deepest one on the way; and whether it is all there.
  std::pair<const Node*, bool> resolve(std::string_view path) const {
    const Node* node = level_.table;
    while (!path.empty()) {
      const size_t dot = std::min(path.find('.'), path.size());
      const Node* next = node->step(path.substr(0, dot));
      if (!next) return {node, false};
      node = next;
      path.remove_prefix(std::min(dot + 1, path.size()));
    }
    return {node, true};
  }

  void report(const Where& where, std::string message) {
    problems_.push_back({where.file, where.line, where.column, std::move(message)});
  }

  Scene& scene_;
  std::vector<Problem>& problems_;
  Level level_;
  bool misread_list_ = false;  ///< there may be more bodies than were read
};

void name_unnamed(Scene& scene) {
  const auto fill = [](auto& things, const char* kind) {
    for (size_t i = 0; i < things.size(); ++i)
      if (things[i].name.empty()) things[i].name = fmt::format("{}-{}", kind, i + 1);
  };
  fill(scene.soft, "soft");
  fill(scene.cloth, "cloth");
  fill(scene.springs, "springs");
  fill(scene.fields, "field");
  fill(scene.colliders, "collider");
  fill(scene.loads, "load");
  fill(scene.attachments, "attach");
}

// A file that says nothing about lights gets one, which overrides find too.
void add_default_light(Node& root) {
  if (root.find("light")) return;
  Node& lights = root.children.emplace_back();
  lights.key = "light";
  lights.kind = Node::Kind::kArray;
  lights.where = root.where;
  lights.children.emplace_back().where = root.where;
}

// File by file from top to bottom, overrides after them; a place that has several things wrong says each.
void sort_problems(std::vector<Problem>& problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    const auto order = [](const Problem& p) { return std::tuple(p.file.starts_with("--set "), p.line, p.column); };
    return order(a) < order(b);
  });
  constexpr size_t kMost = 100;
  if (problems.size() <= kMost) return;
  const size_t rest = problems.size() - kMost;
  problems.resize(kMost);
  problems.push_back({problems.back().file, 0, 0, fmt::format("and {} more", rest)});
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& file, std::span<const std::string> overrides) {
  const std::string name = file.string();
  Node root = parse_toml(text, name);
  root.where = {name, 0, 0};
  add_default_light(root);
  std::vector<Problem> problems;
  apply_overrides(root, overrides, problems);
  Scene scene;
  scene.file = file;
  Reader(root, scene, problems).read();
  if (!problems.empty()) {
    sort_problems(problems);
    throw UserError(ErrorKind::kUsage, std::move(problems));
  }
  name_unnamed(scene);
  return scene;
}

}  // namespace softreel::assets
