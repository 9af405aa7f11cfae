#include "assets/scene_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "assets/scene_colors.h"
#include "assets/scene_nearest.h"
#include "assets/scene_value.h"

namespace softreel::assets {

namespace {

class Lister : public KeyVisitor {
 public:
  std::vector<KeyInfo> keys;

  void key(const Key& key, const ValueRef& value) override {
    KeyInfo& info = keys.emplace_back();
    info.path = prefix_ + key.name;
    info.type = expected_text(key, value, key.range.short_text());
    info.default_text = value_text(value);
    info.choices = value_choices(value);
    info.help = key.help;
    info.physics = key.role == Role::kPhysics;
    info.picture = key.role == Role::kPicture;
  }

  void section(const Section& section, const SectionRef& ref) override {
    const std::string outer = enter(section, KeyInfo::Kind::kSection);
    ref.keys(*this);
    prefix_ = outer;
  }

  void list(const Section& section, const ListRef& ref) override {
    const std::string outer = enter(section, KeyInfo::Kind::kList);
    ref.keys(ref.size, *this);
    prefix_ = outer;
  }

 private:
  std::string enter(const Section& section, KeyInfo::Kind kind) {
    KeyInfo& info = keys.emplace_back();
    info.path = prefix_ + section.name;
    info.kind = kind;
    info.type = kind == KeyInfo::Kind::kList ? "a list of tables" : "a table";
    info.bare.assign(section.bare.begin(), section.bare.end());
    info.help = section.help;
    return std::exchange(prefix_, info.path + ".");
  }

  std::string prefix_;
};

// "[time]", "[[soft]]", "[soft.material]"
std::string heading(const KeyInfo& section) {
  return section.kind == KeyInfo::Kind::kList ? fmt::format("[[{}]]", section.path) : fmt::format("[{}]", section.path);
}

std::string in_table(std::string text) {  // Markdown's tables are cut at every bar
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

}  // namespace

std::string_view KeyInfo::name() const { return std::string_view(path).substr(path.rfind('.') + 1); }

std::string_view KeyInfo::section() const {
  const size_t dot = path.rfind('.');
  return dot == std::string::npos ? std::string_view() : std::string_view(path).substr(0, dot);
}

const std::vector<KeyInfo>& scene_keys() {
  static const std::vector<KeyInfo> keys = [] {
    Lister lister;
    Scene scene;
    walk_scene(lister, scene);
    return std::move(lister.keys);
  }();
  return keys;
}

const KeyInfo* find_key(std::string_view path) {
  const auto& keys = scene_keys();
  const auto it = std::find_if(keys.begin(), keys.end(), [&](const KeyInfo& key) { return key.path == path; });
  return it == keys.end() ? nullptr : &*it;
}

std::string scene_reference_markdown() {
  std::string out;
  const auto rows_of = [&](std::string_view section) {
    std::string rows;
    for (const KeyInfo& key : scene_keys()) {
      if (key.section() != section || (section.empty() && key.kind != KeyInfo::Kind::kValue)) continue;
      rows += fmt::format("| `{}` | {} | {} | {} |\n", key.name(), in_table(key.type),
                          key.default_text.empty() ? "" : fmt::format("`{}`", in_table(key.default_text)),
                          in_table(key.help));
    }
    return rows.empty() ? rows : "\n| key | takes | default | meaning |\n|---|---|---|---|\n" + rows;
  };
  out += "### At the top\n" + rows_of("");
  for (const KeyInfo& section : scene_keys()) {
    if (section.kind == KeyInfo::Kind::kValue) continue;
    out += fmt::format("\n### `{}`\n\n{}", heading(section), section.help);
    if (!section.bare.empty()) out += fmt::format(" (a bare value stands for `{}`)", join_names(section.bare));
    out += ".\n" + rows_of(section.path);
  }
  return out;
}

std::string scene_choices_text() {
  std::string out;
  const std::vector<std::string> colors = color_names();
  for (const KeyInfo& key : scene_keys())
    if (!key.choices.empty() && key.choices != colors)
      out += fmt::format("{:<28} {}\n", key.path, join_names(key.choices));
  return out + fmt::format("{:<28} {}\n", "colours", join_names(colors));
}

}  // namespace softreel::assets
