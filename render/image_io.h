#pragma once
// Pictures from files: PNG, JPEG, TGA, BMP, PSD, GIF, PNM, HDR (as 8 bit), through stb_image.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "render/image.h"

namespace softreel::render {

/// Throws RenderError (kInput) naming the file when it is missing, not a picture, broken, or larger than kMaxImageSide
/// on a side (checked before memory is asked for).
Image load_image(const std::filesystem::path& path);
/// The same from bytes in memory (a texture inside a glTF file); `name` is for the message.
Image load_image(std::span<const std::byte> bytes, const std::string& name);

}  // namespace softreel::render
