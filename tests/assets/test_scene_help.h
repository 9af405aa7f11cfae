#pragma once
// Scenes as text, and what is wrong with them.
#include <string>
#include <string_view>
#include <vector>

#include "assets/error.h"
#include "assets/scene_reader.h"

namespace softreel::assets {

inline const char* const kScene = "scene.toml";

inline Scene parse(std::string_view text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, kScene, overrides);
}

/// Everything that is wrong; empty when nothing is.
inline std::vector<Problem> problems_of(std::string_view text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const UserError& error) {
    return error.problems();
  }
  return {};
}

/// All problems in one text, a line each.
inline std::string report_of(std::string_view text, const std::vector<std::string>& overrides = {}) {
  std::string report;
  for (const Problem& problem : problems_of(text, overrides)) report += problem.text() + "\n";
  return report;
}

inline bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace softreel::assets
