#pragma once
// PNG files with text inside (ISO/IEC 15948; tEXt in 11.3.4.3).
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/image.h"

namespace softreel::render {

/// Keyword -> text. Keywords: 1..79 bytes, printable Latin-1; texts: no NUL.
using PngText = std::map<std::string, std::string>;

/// A complete PNG file in memory; RGB when every pixel is opaque, else RGBA. The same picture and text give the same
/// bytes. Throws std::invalid_argument for a keyword or text that PNG does not allow.
std::vector<unsigned char> encode_png(const Image& image, const PngText& text = {});

/// encode_png into a file, through write_file_atomically.
void write_png(const std::filesystem::path& path, const Image& image, const PngText& text = {});

/// The texts of a PNG file, when it is complete: signature, every chunk's CRC and IEND are right. Otherwise (missing,
/// truncated, garbage) nullopt; never throws for what a file holds. Pixels are not decoded: takes about 0.1 ms per 100
/// KB.
std::optional<PngText> read_png_text(const std::filesystem::path& path);

}  // namespace softreel::render
