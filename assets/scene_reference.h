#pragma once
// Every key of a scene file, for listings, references and messages. Comes from the table in scene_keys.cpp.
#include <string>
#include <string_view>
#include <vector>

namespace softreel::assets {

struct KeyInfo {
  enum class Kind { kValue, kSection, kList };

  std::string path;  ///< "soft.material.young"
  Kind kind = Kind::kValue;
  std::string type;                  ///< in words: "a number [Pa], above 0 and at most 1e+13"
  std::string default_text;          ///< TOML; empty: none
  std::vector<std::string> choices;  ///< names that a value can choose, if it chooses one
  std::vector<std::string> bare;     ///< of a section: the keys that a bare value in its place stands for
  std::string help;                  ///< one line
  bool physics = false;              ///< changing it needs a new simulation
  bool picture = false;              ///< changing it needs new pictures

  std::string_view name() const;     ///< last part of the path
  std::string_view section() const;  ///< the rest; empty at the top
};

/// Every section, list and value, in the order of the table.
const std::vector<KeyInfo>& scene_keys();

/// Null when there is none.
const KeyInfo* find_key(std::string_view path);

/// The reference of the scene file as Markdown, one table per section.
std::string scene_reference_markdown();

/// Every name that a scene can choose (methods, materials, colours), for a terminal.
std::string scene_choices_text();

}  // namespace softreel::assets
