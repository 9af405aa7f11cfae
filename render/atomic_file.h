#pragma once
// Files that are there completely or not at all.
#include <filesystem>
#include <span>

namespace softreel::render {

/// Writes `bytes` under a temporary name in the same folder and renames it to `path`. Nothing is left behind on
/// failure. Throws RenderError (kOutput) with the path and the system's reason (no such folder, no permission, disk
/// full, ...).
void write_file_atomically(const std::filesystem::path& path, std::span<const unsigned char> bytes);

}  // namespace softreel::render
