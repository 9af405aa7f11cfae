#pragma once
// What turntables of meshes and of scenes share: folder, pictures in even steps, video, closing lines.
#include <filesystem>
#include <functional>

#include "app/arguments.h"
#include "render/image.h"

namespace softreel::app {

/// Where the pictures go. Video and folder are tried before anything is computed: throws UserError when they cannot be
/// written.
std::filesystem::path turntable_output(const TurntableArguments& arguments);

/// Writes `picture(angle)` for arguments.count angles [deg] from 0 in even steps, so that the last goes on to the
/// first, then the video. `driver`: noted down in the files. Returns the exit code; throws Interrupted.
int write_turntable(const TurntableArguments& arguments, const std::filesystem::path& output, const std::string& driver,
                    const std::function<render::Image(double angle)>& picture);

}  // namespace softreel::app
