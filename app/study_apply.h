#pragma once
// A copy of a scene file with other settings, its layout and comments kept.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace softreel::app {

/// The text of a scene file with these keys ("time.substeps", "4") set: values that are there are replaced in their
/// place, others added to their table. `file`: of messages. Throws UserError (kUsage) where the text cannot be changed
/// by such means (a table that is spread over several places).
std::string with_settings(const std::string& text, const std::filesystem::path& file,
                          const std::vector<std::pair<std::string, std::string>>& settings);

}  // namespace softreel::app
