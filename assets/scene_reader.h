#pragma once
// From a scene file to a checked Scene.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "assets/scene.h"

namespace softreel::assets {

/// Reads and checks a scene file. `overrides` are "key=value" (see scene_override.h), checked like the file itself.
/// Throws UserError with every problem found: kUsage for what the scene says, kInput when the file cannot be read.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for text; `file` names it in messages, and paths are relative to it. Touches no file.
Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  std::span<const std::string> overrides = {});

/// Checks that the files in `scene.assets` are there. Throws UserError (kInput) with every one that is not.
void check_assets(const Scene& scene);

}  // namespace softreel::assets
