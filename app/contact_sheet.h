#pragma once
// One picture with evenly spaced frames of a clip and their times.
#include <filesystem>
#include <vector>

#include "render/image.h"

namespace softreel::app {

struct SheetFrame {
  std::filesystem::path file;
  double time = 0;  ///< [s]
};

/// At most `most` of the frames, evenly spaced, the first and the last among them.
std::vector<SheetFrame> sheet_frames(const std::vector<SheetFrame>& frames, std::size_t most);

/// The frames, made smaller (light is averaged, not sRGB values), in rows with their times. Throws RenderError for a
/// frame that cannot be read. Needs at least one frame.
render::Image contact_sheet(const std::vector<SheetFrame>& frames);

}  // namespace softreel::app
