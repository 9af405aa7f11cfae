#pragma once
// Frames to an H.264 video through ffmpeg, with settings that play everywhere.
#include <filesystem>
#include <vector>

namespace softreel::app {

/// Throws UserError (kInput) if there is no ffmpeg, (kUsage) if the file's name has no extension of a video container:
/// (kOutput) if the file could not be written: asked before any work is done.
void check_video(const std::filesystem::path& video);

/// Pipes the PNG files, in this order, into ffmpeg: yuv420p, BT.709, faststart; an odd last column or row is left out.
/// Written under a temporary name and renamed. Throws UserError (kOutput) with what ffmpeg said, Interrupted.
void write_video(const std::filesystem::path& video, const std::vector<std::filesystem::path>& frames, double fps);

}  // namespace softreel::app
