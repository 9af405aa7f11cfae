#pragma once
// Pictures from files: PNG, JPEG, TGA, BMP, HDR (as 8 bit), through stb_image.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/image.h"

namespace softreel::render {

/// Throws RenderError (kInput) naming the file when it is missing, not a picture, broken, or larger than kMaxImageSide
/// on a side (checked before memory is asked for).
Image load_image(const std::filesystem::path& path);
/// The same from bytes in memory (a texture inside a glTF file); `name` is for the message.
Image load_image(std::span<const std::byte> bytes, const std::string& name);

/// Has the picture more than the 8 bits a channel that load_image keeps? False for what is no picture.
bool has_finer_levels(std::span<const std::byte> bytes);

/// All 16 bits of each channel, 4 values a pixel; of a picture that load_image has accepted. Throws RenderError
/// (kInput).
std::vector<std::uint16_t> load_fine(std::span<const std::byte> bytes, const std::string& name);

/// One number per pixel: a grey picture of 8 or 16 bits, whose value is the number, such as a picture of body ids.
struct IdPicture {
  int width = 0, height = 0;       ///< [px]
  std::vector<std::uint16_t> ids;  ///< width * height
};
/// Throws RenderError (kInput), also for a picture with colours.
IdPicture load_ids(const std::filesystem::path& path);

/// The bytes of a picture file of at most 1 GiB. Throws RenderError (kInput) naming the file.
std::vector<std::byte> read_picture_file(const std::filesystem::path& path);

}  // namespace softreel::render
