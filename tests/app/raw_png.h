#pragma once
// PNG files of any kind, written by hand: nothing is filtered or compressed.
#include <string>

#include "render/image.h"

namespace softreel::test {

/// ISO/IEC 15948. `color`: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA; `rows`: the samples, without filter
/// bytes; `palette`: PLTE, 3 bytes a colour.
std::string raw_png(int width, int height, int depth, int color, const std::string& rows,
                    const std::string& palette = "");

/// The same pixels as encode_png writes, in other bytes.
std::string stored_png(const render::Image& image);

}  // namespace softreel::test
