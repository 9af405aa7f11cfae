#include "render/jpeg_check.h"

namespace softreel::render {

namespace {

constexpr unsigned kStartOfImage = 0xd8, kHuffmanTables = 0xc4, kStartOfScan = 0xda;
constexpr int kMostCodes = 256, kCodeLengths = 16;

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  /// 0 beyond the end, as stb reads.
  unsigned byte(std::size_t at) const { return at < bytes_.size() ? std::to_integer<unsigned>(bytes_[at]) : 0u; }
  long length(std::size_t at) const { return static_cast<long>(byte(at) << 8 | byte(at + 1)); }
  std::size_t size() const { return bytes_.size(); }

  /// Of the segment whose length stands at `at`.
  bool tables_fit(std::size_t at) const {
    long left = length(at) - 2;
    at += 2;
    while (left > 0 && at < size()) {
      int codes = 0;
      for (std::size_t i = 1; i <= kCodeLengths; ++i) codes += static_cast<int>(byte(at + i));
      if (codes > kMostCodes) return false;
      at += 1 + kCodeLengths + static_cast<std::size_t>(codes);
      left -= 1 + kCodeLengths + codes;
    }
    return true;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

std::string jpeg_damage(std::span<const std::byte> bytes) {
  const Reader file(bytes);
  if (file.byte(0) != 0xff || file.byte(1) != kStartOfImage) return {};
  constexpr const char* kDamaged = "its Huffman tables are damaged";
  std::size_t at = 2;
  // Segment by segment up to the first scan: what looks like a table inside of a colour profile is none.
  while (at + 4 <= file.size() && file.byte(at) == 0xff && file.byte(at + 1) != kStartOfScan) {
    const unsigned marker = file.byte(at + 1);
    if (marker == 0xff) {  // a fill byte
      ++at;
      continue;
    }
    if (marker == kHuffmanTables && !file.tables_fit(at + 2)) return kDamaged;
    at += 2 + static_cast<std::size_t>(file.length(at + 2));
  }
  // From there on, and behind anything that is no segment, whatever the decoder could take for a table.
  for (; at + 4 <= file.size(); ++at)
    if (file.byte(at) == 0xff && file.byte(at + 1) == kHuffmanTables && !file.tables_fit(at + 2)) return kDamaged;
  return {};
}

}  // namespace softreel::render
