// What touches the disk: the scene file itself, and whether its assets are there.
#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "assets/error.h"
#include "assets/scene_limits.h"
#include "assets/scene_nearest.h"
#include "assets/scene_reader.h"

namespace softreel::assets {

namespace fs = std::filesystem;

namespace {

// Files of the same folder whose name may have been meant.
std::string nearest_file(const fs::path& missing) {
  constexpr int kMost = 5000;
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = missing.has_parent_path() ? missing.parent_path() : fs::path(".");
  for (fs::directory_iterator it(folder, error), end; !error && it != end && names.size() < kMost; it.increment(error))
    names.push_back(it->path().filename().string());
  const std::string nearest = nearest_name(missing.filename().string(), names);
  return nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", (missing.parent_path() / nearest).string());
}

// What keeps a file from being read, or nothing.
std::string unusable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    if (file.has_parent_path() && !fs::is_directory(file.parent_path(), error))
      return fmt::format("there is no folder \"{}\"", file.parent_path().string());
    return fmt::format("there is no file \"{}\"{}", file.string(), nearest_file(file));
  }
  if (error) return fmt::format("\"{}\" cannot be read: {}", file.string(), error.message());
  if (status.type() == fs::file_type::directory) return fmt::format("\"{}\" is a folder, not a file", file.string());
  if (status.type() != fs::file_type::regular) return fmt::format("\"{}\" is not a plain file", file.string());
  if (!std::ifstream(file, std::ios::binary))
    return fmt::format("\"{}\" cannot be opened; check its permissions", file.string());
  return {};
}

}  // namespace

Scene read_scene(const fs::path& file, std::span<const std::string> overrides) {
  if (const std::string reason = unusable(file); !reason.empty())
    throw UserError(ErrorKind::kInput, "", "scene file: " + reason);
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error || size > kLargestSceneFile)
    throw UserError(
        ErrorKind::kInput, file.string(),
        fmt::format("{} bytes are too many for a scene file, at most {}; is it a mesh?", size, kLargestSceneFile));
  std::string text(size, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size))
    throw UserError(ErrorKind::kInput, file.string(), "cannot be read to its end");
  return parse_scene(text, file, overrides);
}

void check_assets(const Scene& scene) {
  std::vector<Problem> problems;
  for (const AssetUse& use : scene.assets)
    if (const std::string reason = unusable(scene.asset_path(use.path)); !reason.empty())
      problems.push_back({use.file, use.line, use.column, use.key + ": " + reason});
  if (!problems.empty()) throw UserError(ErrorKind::kInput, std::move(problems));
}

}  // namespace softreel::assets
