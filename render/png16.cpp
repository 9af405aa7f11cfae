#include "render/png16.h"

#include <libdeflate.h>

#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "render/atomic_file.h"

namespace softreel::render {

namespace {

using Bytes = std::vector<unsigned char>;

void add_u32(Bytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<unsigned char>(value >> shift));
}

void add_chunk(Bytes& out, std::string_view type, const Bytes& data) {
  add_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  add_u32(out, libdeflate_crc32(0, out.data() + begin, out.size() - begin));
}

/// Rows with the filter "Sub": differences to the pixel on the left.
Bytes filtered(int width, int height, int channels, std::span<const std::uint16_t> samples) {
  const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  Bytes out;
  out.reserve(static_cast<std::size_t>(height) * (2 * row + 1));
  const auto left_of = static_cast<std::size_t>(channels);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    out.push_back(1);
    const std::uint16_t* line = samples.data() + y * row;
    for (std::size_t i = 0; i < row; ++i) {
      const std::uint16_t left = i < left_of ? 0 : line[i - left_of];
      out.push_back(static_cast<unsigned char>((line[i] >> 8) - (left >> 8)));
      out.push_back(static_cast<unsigned char>((line[i] & 255) - (left & 255)));
    }
  }
  return out;
}

Bytes compressed(const Bytes& data) {
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> deflate(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!deflate) throw std::bad_alloc();
  Bytes out(libdeflate_zlib_compress_bound(deflate.get(), data.size()));
  out.resize(libdeflate_zlib_compress(deflate.get(), data.data(), data.size(), out.data(), out.size()));
  return out;
}

}  // namespace

void write_png16(const std::filesystem::path& path, int width, int height, int channels,
                 std::span<const std::uint16_t> samples, const PngText& text) {
  if (width < 1 || height < 1 || (channels != 1 && channels != 3) ||
      samples.size() !=
          static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels))
    throw std::invalid_argument("a 16-bit picture whose samples do not fit its size");
  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  add_u32(header, static_cast<std::uint32_t>(width));
  add_u32(header, static_cast<std::uint32_t>(height));
  header.insert(header.end(), {16, static_cast<unsigned char>(channels == 3 ? 2 : 0), 0, 0, 0});
  add_chunk(file, "IHDR", header);
  for (const auto& [key, value] : text) {
    Bytes data(key.begin(), key.end());
    data.push_back(0);
    data.insert(data.end(), value.begin(), value.end());
    add_chunk(file, "tEXt", data);
  }
  add_chunk(file, "IDAT", compressed(filtered(width, height, channels, samples)));
  add_chunk(file, "IEND", {});
  write_file_atomically(path, file);
}

}  // namespace softreel::render
