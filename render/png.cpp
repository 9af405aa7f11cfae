#include "render/png.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "render/atomic_file.h"
#include "render/png_stb.h"

namespace softreel::render {

namespace {

constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kHeaderEnd = 8 + 12 + 13;        // signature and IHDR
constexpr std::uint32_t kMaxTextLength = 1024 * 1024;  // [bytes] far above what we write

void append_u32(std::vector<unsigned char>& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<unsigned char>(value >> shift));
}

std::uint32_t u32_at(const unsigned char* bytes) {
  return (std::uint32_t{bytes[0]} << 24) | (std::uint32_t{bytes[1]} << 16) | (std::uint32_t{bytes[2]} << 8) | bytes[3];
}

void check_text(const std::string& keyword, const std::string& text) {
  const auto printable = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 32 && byte <= 126) || byte >= 161;
  };
  if (keyword.empty() || keyword.size() > 79 || !std::all_of(keyword.begin(), keyword.end(), printable))
    throw std::invalid_argument(
        fmt::format("PNG text: \"{}\" is not a keyword of 1 to 79 printable characters", keyword));
  if (text.find('\0') != std::string::npos || text.size() > kMaxTextLength / 2)
    throw std::invalid_argument(fmt::format("PNG text: the text of \"{}\" holds a NUL or is too long", keyword));
}

void append_text_chunk(std::vector<unsigned char>& out, const std::string& keyword, const std::string& text) {
  append_u32(out, static_cast<std::uint32_t>(keyword.size() + 1 + text.size()));
  const std::size_t begin = out.size();
  for (const char c : std::string("tEXt") + keyword) out.push_back(static_cast<unsigned char>(c));
  out.push_back(0);
  for (const char c : text) out.push_back(static_cast<unsigned char>(c));
  append_u32(out, libdeflate_crc32(0, out.data() + begin, out.size() - begin));
}

bool is_opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != 255) return false;
  return true;
}

std::vector<unsigned char> without_alpha(const Image& image) {
  std::vector<unsigned char> rgb(image.pixel_count() * 3);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3,
                rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  return rgb;
}

/// Reads a PNG chunk by chunk; `data` is kept only for tEXt.
class ChunkReader {
 public:
  explicit ChunkReader(const std::filesystem::path& path) : file_(path, std::ios::binary) {
    std::error_code error;
    left_ = std::filesystem::file_size(path, error);
    if (error) left_ = 0;
  }
  bool signature() {
    std::array<unsigned char, 8> bytes{};
    return read(bytes) && bytes == kSignature;
  }
  /// False at the end and on anything that is not a whole chunk with the right CRC.
  bool next(std::string& type, std::string& data) {
    std::array<unsigned char, 8> header{};
    if (!read(header)) return false;
    std::uint64_t length = u32_at(header.data());
    type.assign(header.begin() + 4, header.end());
    data.clear();
    if (length + 4 > left_ || (type == "tEXt" && length > kMaxTextLength)) return false;
    std::uint32_t crc = libdeflate_crc32(0, header.data() + 4, 4);
    while (length > 0) {
      const auto block = std::span(buffer_).first(std::min<std::uint64_t>(length, buffer_.size()));
      if (!read(block)) return false;
      crc = libdeflate_crc32(crc, block.data(), block.size());
      if (type == "tEXt") data.append(block.begin(), block.end());
      length -= block.size();
    }
    std::array<unsigned char, 4> stored{};
    return read(stored) && u32_at(stored.data()) == crc;
  }
  bool at_end() const { return left_ == 0; }

 private:
  bool read(std::span<unsigned char> bytes) {
    if (bytes.size() > left_) return false;
    left_ -= bytes.size();
    return static_cast<bool>(
        file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())));
  }

  std::ifstream file_;
  std::uint64_t left_ = 0;
  std::vector<unsigned char> buffer_ = std::vector<unsigned char>(1 << 16);
};

}  // namespace

std::vector<unsigned char> encode_png(const Image& image, const PngText& text) {
  if (image.width < 1 || image.height < 1 || image.rgba.size() != image.pixel_count() * 4)
    throw std::invalid_argument("PNG: a picture without pixels, or with the wrong number of them");
  for (const auto& [keyword, value] : text) check_text(keyword, value);

  const std::vector<unsigned char> plain = is_opaque(image)
                                               ? encode_png_stb(without_alpha(image), image.width, image.height, 3)
                                               : encode_png_stb(image.rgba, image.width, image.height, 4);
  std::vector<unsigned char> png(plain.begin(), plain.begin() + kHeaderEnd);
  for (const auto& [keyword, value] : text) append_text_chunk(png, keyword, value);
  png.insert(png.end(), plain.begin() + kHeaderEnd, plain.end());
  return png;
}

void write_png(const std::filesystem::path& path, const Image& image, const PngText& text) {
  write_file_atomically(path, encode_png(image, text));
}

std::optional<PngText> read_png_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  ChunkReader reader(path);
  if (!reader.signature()) return std::nullopt;
  PngText text;
  std::string type;
  std::string data;
  bool first = true;
  bool has_pixels = false;
  while (reader.next(type, data)) {
    if (first != (type == "IHDR")) return std::nullopt;
    first = false;
    has_pixels = has_pixels || type == "IDAT";
    if (type == "IEND") return has_pixels && reader.at_end() ? std::optional(text) : std::nullopt;
    const std::size_t separator = data.find('\0');
    if (type == "tEXt" && separator != std::string::npos)
      text.emplace(data.substr(0, separator), data.substr(separator + 1));
  }
  return std::nullopt;
}

}  // namespace softreel::render
