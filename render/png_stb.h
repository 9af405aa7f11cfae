#pragma once
// stb_image_write behind one function.
#include <span>
#include <vector>

namespace softreel::render {

/// A PNG file without text chunks. `pixels`: height rows of width * channels bytes; channels: 3 or 4. May be called
/// from several threads. Throws std::bad_alloc.
std::vector<unsigned char> encode_png_stb(std::span<const unsigned char> pixels, int width, int height, int channels);

}  // namespace softreel::render
