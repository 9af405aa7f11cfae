#include "tests/app/raw_png.h"

#include <algorithm>
#include <cstdint>

namespace softreel::test {
namespace {

std::string big_endian(std::uint32_t v) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> shift);
  return bytes;
}

std::uint32_t crc(const std::string& bytes) {
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc(type + data));
}

/// RFC 1950 around stored blocks of RFC 1951.
std::string stored_zlib(const std::string& data) {
  std::string out("\x78\x01", 2);
  std::size_t at = 0;
  do {
    const std::size_t n = std::min<std::size_t>(data.size() - at, 65535);
    out += at + n == data.size() ? '\1' : '\0';
    for (const std::size_t v : {n, n ^ 0xffff}) {
      out += static_cast<char>(v & 255);
      out += static_cast<char>(v >> 8);
    }
    out += data.substr(at, n);
    at += n;
  } while (at < data.size());
  std::uint32_t a = 1, b = 0;
  for (const char byte : data) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  return out + big_endian(b << 16 | a);
}

}  // namespace

std::string raw_png(int width, int height, int depth, int color, const std::string& rows, const std::string& palette) {
  // At least one: a header may promise more than there is.
  const std::size_t row = std::max<std::size_t>(height > 0 ? rows.size() / static_cast<std::size_t>(height) : 0, 1);
  std::string filtered;
  for (std::size_t y = 0; y * row < rows.size(); ++y) filtered += '\0' + rows.substr(y * row, row);
  std::string header = big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height));
  header += static_cast<char>(depth);
  header += static_cast<char>(color);
  header += std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + (palette.empty() ? "" : chunk("PLTE", palette)) +
         chunk("IDAT", stored_zlib(filtered)) + chunk("IEND", "");
}

std::string stored_png(const render::Image& image) {
  return raw_png(image.width, image.height, 8, 6, std::string(image.rgba.begin(), image.rgba.end()));
}

}  // namespace softreel::test
