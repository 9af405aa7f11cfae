#include "tests/app/comparison.h"

namespace softreel::test {

render::Image gradient(int width, int height) {
  render::Image image = render::Image::blank(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* pixel = image.pixel(x, y);
      pixel[0] = static_cast<std::uint8_t>(x * 4);
      pixel[1] = static_cast<std::uint8_t>(y * 4);
      pixel[2] = 100;
      pixel[3] = 255;
    }
  return image;
}

render::Image changed(int levels, int pixels) {
  render::Image image = gradient();
  for (int i = 0; i < pixels; ++i) {
    std::uint8_t& green = image.rgba[static_cast<std::size_t>(4 * i + 1)];
    green = static_cast<std::uint8_t>(green + levels);
  }
  return image;
}

render::Image moving_disc(int time) {
  render::Image image = render::Image::blank(96, 54);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int dx = x - 10 - 4 * time, dy = y - 27;
      const bool inside = dx * dx + dy * dy < 100;
      std::uint8_t* pixel = image.pixel(x, y);
      pixel[0] = pixel[1] = pixel[2] = inside ? 240 : 60;
      pixel[3] = 255;
    }
  return image;
}

RunResult compare(const std::filesystem::path& a, const std::filesystem::path& b, std::vector<std::string> more) {
  more.insert(more.begin(), {"compare", a.string(), b.string()});
  return run(more);
}

}  // namespace softreel::test
