#pragma once
// Small scenes, and what may be asked of the folders that they are rendered into.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"
#include "tests/assets/support.h"

namespace softreel::test {

/// 48 x 32 pixels, 2 samples, 8 frames: a hanging mass-spring cloth, a soft block, a smooth sphere under both.
std::string small_scene();

/// The same pictures of one mass-spring cloth that hangs from one side; nothing else. Explicit camera, ground and
/// light, so that no frame depends on another.
std::string hanging_cloth();

/// File name (relative) -> bytes of every file below a folder.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

/// Of these, pictures ("frame_0001.png") and cached states ("frame_0001.state").
std::map<std::string, std::string> pictures_in(const std::filesystem::path& folder);
std::map<std::string, std::string> states_in(const std::filesystem::path& folder);

/// Nothing half-done has a final name: every PNG is complete; and no temporary file is left.
void check_only_whole_files(const std::filesystem::path& folder);

/// Runs `softreel` with these arguments and --stats; CHECKs success; what the stats file says.
nlohmann::json stats_of(std::vector<std::string> arguments, const TempFolder& folder);

}  // namespace softreel::test
