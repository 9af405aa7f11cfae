#pragma once
// Where two pictures differ, as a picture.
#include "render/image.h"

namespace softreel::render {

/// The reference in dimmed grey; over it every pixel that differs, from dark red (1 level) over yellow to white (64
/// levels and more). For pictures of different sizes: the larger size, what only one of them covers in blue.
Image difference_picture(const Image& reference, const Image& actual);

}  // namespace softreel::render
