#include <cmath>
#include <fstream>
#include <memory>
#include <vector>

#include "render/error.h"
#include "render/hdr_check.h"
#include "render/image_io.h"
#include "render/look.h"
#include "render/panorama.h"

// Only the reader of .hdr files: a translation unit of its own, so that image_io keeps the 8-bit side.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_HDR
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace softreel::render {

namespace {

HdrImage from_bytes(const std::filesystem::path& path) {
  const Image image = load_image(path);
  HdrImage hdr{image.width, image.height, {}, 0};
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    hdr.pixels.push_back(
        linear_from_srgb(glm::vec3(image.rgba[4 * i], image.rgba[4 * i + 1], image.rgba[4 * i + 2]) / 255.0f));
  return hdr;
}

}  // namespace

HdrImage load_hdr(const std::filesystem::path& path) {
  if (stbi_is_hdr(path.c_str()) == 0) return from_bytes(path);
  if (const std::string damage = hdr_damage(read_picture_file(path)); !damage.empty())
    throw RenderError(RenderErrorKind::kInput, "cannot use " + path.string() + " as a picture: " + damage);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<float, decltype(&stbi_image_free)> data(stbi_loadf(path.c_str(), &width, &height, &channels, 3),
                                                                &stbi_image_free);
  if (!data)
    throw RenderError(RenderErrorKind::kInput,
                      "cannot use " + path.string() + " as a picture: " + stbi_failure_reason());
  HdrImage hdr{width, height, {}, 0};
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  hdr.pixels.reserve(count);
  constexpr float kBrightest = 1e6f;  // sums over all directions stay finite
  for (std::size_t i = 0; i < count; ++i) {
    glm::vec3 p(data.get()[3 * i], data.get()[3 * i + 1], data.get()[3 * i + 2]);
    bool sound = true;
    for (int c = 0; c < 3; ++c) sound = sound && std::isfinite(p[c]) && p[c] >= 0;
    if (!sound) {
      p = glm::vec3(0);
      ++hdr.mended;
    }
    if (sound && glm::any(glm::greaterThan(p, glm::vec3(kBrightest)))) ++hdr.mended;
    hdr.pixels.push_back(glm::min(p, kBrightest));
  }
  return hdr;
}

}  // namespace softreel::render
