#include "render/image.h"

#include <fmt/format.h>

#include <stdexcept>

namespace softreel::render {

Image Image::blank(int width, int height) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
    throw std::invalid_argument(
        fmt::format("a picture of {} x {} pixels: each side must be 1 to {}", width, height, kMaxImageSide));
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(image.pixel_count() * 4, 0);
  return image;
}

}  // namespace softreel::render
