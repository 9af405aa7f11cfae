#include "render/png_decode.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace softreel::render {

namespace {

constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::uint32_t u32_at(const std::byte* p) {
  return (std::to_integer<std::uint32_t>(p[0]) << 24) | (std::to_integer<std::uint32_t>(p[1]) << 16) |
         (std::to_integer<std::uint32_t>(p[2]) << 8) | std::to_integer<std::uint32_t>(p[3]);
}

struct Chunk {
  std::string type;
  std::span<const std::byte> data;
  std::uint32_t stored_crc = 0;

  bool critical() const { return (type[0] & 0x20) == 0; }
  bool intact() const { return libdeflate_crc32(0, data.data() - 4, data.size() + 4) == stored_crc; }
};

/// The chunk at `position`, which moves behind it; nullopt if the file ends inside.
std::optional<Chunk> next_chunk(std::span<const std::byte> bytes, std::size_t& position) {
  if (bytes.size() - position < 12) return std::nullopt;
  const std::size_t length = u32_at(bytes.data() + position);
  if (length > bytes.size() - position - 12) return std::nullopt;
  Chunk chunk;
  chunk.type.assign(reinterpret_cast<const char*>(bytes.data() + position + 4), 4);
  chunk.data = bytes.subspan(position + 8, length);
  chunk.stored_crc = u32_at(bytes.data() + position + 8 + length);
  position += 12 + length;
  return chunk;
}

struct Header {
  int width = 0, height = 0, channels = 0;
};

/// Of the kinds that are read here.
std::optional<Header> plain_header(std::span<const std::byte> data) {
  if (data.size() != 13) return std::nullopt;
  const std::uint32_t width = u32_at(data.data()), height = u32_at(data.data() + 4);
  const int depth = std::to_integer<int>(data[8]), color = std::to_integer<int>(data[9]);
  const bool usual = data[10] == std::byte{0} && data[11] == std::byte{0} && data[12] == std::byte{0};
  const int channels = color == 0 ? 1 : color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 0;
  if (depth != 8 || channels == 0 || !usual || width < 1 || height < 1 || width > kMaxImageSide ||
      height > kMaxImageSide)
    return std::nullopt;
  return Header{static_cast<int>(width), static_cast<int>(height), channels};
}

std::uint8_t paeth(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  return static_cast<std::uint8_t>(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
}

/// ISO/IEC 15948, 9.2, in place; `above` of the first row is zeros. kChannels fixed: the compiler keeps the last pixel
/// in registers. False for a filter that does not exist.
template <int kChannels>
bool undo_filter(int filter, std::uint8_t* row, const std::uint8_t* above, int size) {
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (int i = kChannels; i < size; ++i) row[i] = static_cast<std::uint8_t>(row[i] + row[i - kChannels]);
      return true;
    case 2:
      for (int i = 0; i < size; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
      return true;
    case 3:
      for (int i = 0; i < kChannels; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i] / 2);
      for (int i = kChannels; i < size; ++i)
        row[i] = static_cast<std::uint8_t>(row[i] + (row[i - kChannels] + above[i]) / 2);
      return true;
    case 4:
      for (int i = 0; i < kChannels; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
      for (int i = kChannels; i < size; ++i)
        row[i] = static_cast<std::uint8_t>(row[i] + paeth(row[i - kChannels], above[i], above[i - kChannels]));
      return true;
    default:
      return false;
  }
}

template <int kChannels>
void expand(const std::uint8_t* row, int width, std::uint8_t* __restrict rgba) {
  for (int x = 0; x < width; ++x, row += kChannels, rgba += 4) {
    rgba[0] = row[0];
    rgba[1] = row[kChannels >= 3 ? 1 : 0];
    rgba[2] = row[kChannels >= 3 ? 2 : 0];
    rgba[3] = kChannels == 2 ? row[1] : kChannels == 4 ? row[3] : std::uint8_t{255};
  }
}

template <int kChannels>
std::optional<Image> unpack(std::vector<std::uint8_t>& raw, const Header& h) {
  const int size = h.width * kChannels;
  const std::vector<std::uint8_t> zeros(static_cast<std::size_t>(size));
  Image image = Image::blank(h.width, h.height);
  const std::uint8_t* above = zeros.data();
  for (int y = 0; y < h.height; ++y) {
    std::uint8_t* row = raw.data() + static_cast<std::size_t>(y) * (static_cast<std::size_t>(size) + 1);
    if (!undo_filter<kChannels>(row[0], row + 1, above, size)) return std::nullopt;
    expand<kChannels>(row + 1, h.width, image.pixel(0, y));
    above = row + 1;
  }
  return image;
}

/// Fills `raw` exactly, or says that it cannot.
bool inflate_to(std::span<const std::byte> packed, std::vector<std::uint8_t>& raw) {
  struct Free {
    void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
  };
  const std::unique_ptr<libdeflate_decompressor, Free> decompressor(libdeflate_alloc_decompressor());
  return decompressor && libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), raw.data(),
                                                    raw.size(), nullptr) == LIBDEFLATE_SUCCESS;
}

}  // namespace

bool has_png_signature(std::span<const std::byte> bytes) {
  return bytes.size() >= kSignature.size() && std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) == 0;
}

std::string png_damage(std::span<const std::byte> bytes) {
  std::size_t position = kSignature.size();
  bool first = true;
  while (const std::optional<Chunk> chunk = next_chunk(bytes, position)) {
    if (first != (chunk->type == "IHDR")) return "its first part is not a PNG header";
    first = false;
    if (chunk->critical() && !chunk->intact())
      return fmt::format("its part {} is damaged: the checksum does not fit", chunk->type);
    if (chunk->type == "IEND") return {};
  }
  return "it is truncated, or damaged in the middle";
}

std::optional<Image> decode_plain_png(std::span<const std::byte> bytes) {
  std::optional<Header> header;
  std::vector<std::byte> joined;  // only where the pixels come in several chunks
  std::span<const std::byte> packed;
  std::size_t position = kSignature.size();
  while (const std::optional<Chunk> chunk = next_chunk(bytes, position)) {
    if (chunk->type == "IHDR") header = plain_header(chunk->data);
    if (!header || chunk->type == "tRNS") return std::nullopt;
    if (chunk->type == "IEND") break;
    if (chunk->type != "IDAT") continue;
    if (!packed.empty() && joined.empty()) joined.assign(packed.begin(), packed.end());
    if (!joined.empty())
      joined.insert(joined.end(), chunk->data.begin(), chunk->data.end());
    else
      packed = chunk->data;
  }
  if (!joined.empty()) packed = joined;
  if (!header || packed.empty()) return std::nullopt;
  const std::size_t size = (static_cast<std::size_t>(header->width) * static_cast<std::size_t>(header->channels) + 1) *
                           static_cast<std::size_t>(header->height);
  // Deflate cannot pack tighter than 1 : 1032, so that a small file does not ask for much memory.
  if (size / 1032 > packed.size()) return std::nullopt;
  std::vector<std::uint8_t> raw(size);
  if (!inflate_to(packed, raw)) return std::nullopt;
  switch (header->channels) {
    case 1:
      return unpack<1>(raw, *header);
    case 2:
      return unpack<2>(raw, *header);
    case 3:
      return unpack<3>(raw, *header);
    default:
      return unpack<4>(raw, *header);
  }
}

}  // namespace softreel::render
