#pragma once
// Text on finished pictures, in DejaVu Sans, which is part of the program.
#include <glm/glm.hpp>
#include <string_view>

#include "render/image.h"

namespace softreel::render {

/// Width of a line of text [px]; `size`: height of a line's letters from the deepest to the highest [px].
float text_width(std::string_view text, float size);

/// Draws UTF-8 text; `x`: its left end, `baseline`: y of the line that letters stand on [px], both may lie between
/// pixels. What falls outside of the picture is cut off.
void draw_text(Image& image, std::string_view text, float x, float baseline, float size, const glm::vec3& srgb);

}  // namespace softreel::render
