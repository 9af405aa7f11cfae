#include "render/image.h"

#include <cstddef>

namespace softreel::render {

Image Image::blank(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 0);
  return image;
}

}  // namespace softreel::render
