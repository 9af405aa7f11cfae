#include "render/image.h"

namespace softreel::render {

Image Image::blank(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(static_cast<size_t>(width) * static_cast<size_t>(height) * 4, 0);
  return image;
}

}  // namespace softreel::render
