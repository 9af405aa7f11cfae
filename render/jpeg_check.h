#pragma once
// What stb_image does not check in a JPEG file, and would write beyond its tables for.
#include <cstddef>
#include <span>
#include <string>

namespace softreel::render {

/// What is wrong with the Huffman tables of a JPEG file (ITU-T T.81, B.2.4.2), in words: more than the 256 codes that a
/// byte can choose from. Empty where nothing is wrong, and for what is no JPEG.
std::string jpeg_damage(std::span<const std::byte> bytes);

}  // namespace softreel::render
