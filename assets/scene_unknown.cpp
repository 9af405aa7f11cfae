#include "assets/scene_unknown.h"

#include <fmt/format.h>

#include <algorithm>

#include "assets/scene_nearest.h"
#include "assets/scene_reference.h"

namespace softreel::assets {

namespace {

std::string bracketed(std::string_view section) {
  if (section.empty()) return "at the top of the file";
  const KeyInfo* info = find_key(section);
  const bool list = info && info->kind == KeyInfo::Kind::kList;
  return list ? fmt::format("in [[{}]]", section) : fmt::format("in [{}]", section);
}

// How far two paths agree at their beginning.
size_t shared_length(std::string_view a, std::string_view b) {
  return static_cast<size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

std::vector<std::string> key_names(std::string_view section) {
  std::vector<std::string> names;
  for (const KeyInfo& key : scene_keys())
    if (key.section() == section) names.emplace_back(key.name());
  return names;
}

std::string unknown_key_text(std::string_view section, std::string_view word) {
  const std::string what =
      fmt::format("unknown {} \"{}\" {}", section.empty() ? "key or section" : "key", word, bracketed(section));
  const std::vector<std::string> here = key_names(section);
  const KeyInfo* elsewhere = nullptr;
  for (const KeyInfo& key : scene_keys())
    if (key.name() == word &&
        (!elsewhere || shared_length(key.section(), section) > shared_length(elsewhere->section(), section)))
      elsewhere = &key;
  const std::string nearest = nearest_name(word, here);
  const bool certain = !nearest.empty() && edit_distance(word, nearest) <= 1;
  if (elsewhere && !certain) return fmt::format("{}; it belongs {}", what, bracketed(elsewhere->section()));
  if (!nearest.empty()) return fmt::format("{}; did you mean \"{}\"?", what, nearest);
  return fmt::format("{}; there is: {}", what, join_names(here));
}

}  // namespace softreel::assets
