#pragma once
// PNG files of 16 bits a channel, for numbers instead of colours.
#include <cstdint>
#include <filesystem>
#include <span>

#include "render/png.h"

namespace softreel::render {

/// `samples`: width * height * channels, rows from top to bottom; `channels`: 1 (grey) or 3 (RGB). The same input gives
/// the same bytes. Written through write_file_atomically. Throws std::invalid_argument for a size that does not fit.
void write_png16(const std::filesystem::path& path, int width, int height, int channels,
                 std::span<const std::uint16_t> samples, const PngText& text = {});

}  // namespace softreel::render
