#include "render/image_io.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "render/error.h"
#include "render/hdr_check.h"
#include "render/jpeg_check.h"
#include "render/png_decode.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
// Readers that write or read beyond their memory for damaged files (PNM: found by fuzzing; GIF, PSD, PIC: known of the
// version that Debian has), for kinds of pictures that nobody renders into.
#define STBI_NO_PNM
#define STBI_NO_GIF
#define STBI_NO_PSD
#define STBI_NO_PIC
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>

namespace softreel::render {

static_assert(STBI_MAX_DIMENSIONS == kMaxImageSide);

namespace {

constexpr std::uintmax_t kMaxFileSize = 1u << 30;  // [bytes]; stb counts in int

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw RenderError(RenderErrorKind::kInput, fmt::format("cannot use {} as a picture: {}", name, why));
}

}  // namespace

Image load_image(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) refuse(name, "it is empty");
  if (bytes.size() > kMaxFileSize) refuse(name, "it is larger than 1 GiB");
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (const std::string damage = jpeg_damage(bytes); !damage.empty()) refuse(name, damage);
  if (const std::string damage = hdr_damage(bytes); !damage.empty()) refuse(name, damage);
  // The header alone first: an absurd size must not ask for memory.
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0)
    refuse(name, fmt::format("{} (PNG, JPEG, TGA, BMP and HDR can be read)", stbi_failure_reason()));
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
    refuse(name, fmt::format("{} x {} pixels; a side may have 1 to {}", width, height, kMaxImageSide));
  if (has_png_signature(bytes)) {
    // stb does not look at the checksums, and would make a picture of what is left.
    if (const std::string damage = png_damage(bytes); !damage.empty()) refuse(name, damage);
    if (std::optional<Image> image = decode_plain_png(bytes)) return std::move(*image);
  }

  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), &stbi_image_free);
  if (!pixels) refuse(name, stbi_failure_reason());
  Image image = Image::blank(width, height);
  std::memcpy(image.rgba.data(), pixels.get(), image.rgba.size());
  return image;
}

std::vector<std::byte> read_picture_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(path.string(), "there is no such file");
  if (!std::filesystem::is_regular_file(status)) refuse(path.string(), "it is not a file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse(path.string(), error.message());
  if (size > kMaxFileSize) refuse(path.string(), "it is larger than 1 GiB");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path.string(), std::generic_category().message(errno));
  std::vector<std::byte> bytes(size);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    refuse(path.string(), "it cannot be read");
  return bytes;
}

Image load_image(const std::filesystem::path& path) { return load_image(read_picture_file(path), path.string()); }

bool has_finer_levels(std::span<const std::byte> bytes) {
  return bytes.size() <= kMaxFileSize && stbi_is_16_bit_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                                                    static_cast<int>(bytes.size())) != 0;
}

std::vector<std::uint16_t> load_fine(std::span<const std::byte> bytes, const std::string& name) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_us, decltype(&stbi_image_free)> values(
      stbi_load_16_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width,
                               &height, &channels, 4),
      &stbi_image_free);
  if (!values) refuse(name, stbi_failure_reason());
  return {values.get(), values.get() + static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4};
}

IdPicture load_ids(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_picture_file(path);
  const Image image = load_image(bytes, path.string());
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != image.rgba[i + 1] || image.rgba[i] != image.rgba[i + 2])
      refuse(path.string(), "it has colours; ids are grey, of 8 or 16 bits");
  IdPicture picture{image.width, image.height, {}};
  picture.ids.reserve(image.pixel_count());
  if (has_finer_levels(bytes)) {
    const std::vector<std::uint16_t> fine = load_fine(bytes, path.string());
    for (std::size_t i = 0; i < fine.size(); i += 4) picture.ids.push_back(fine[i]);
  } else {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) picture.ids.push_back(image.rgba[i]);
  }
  return picture;
}

}  // namespace softreel::render
