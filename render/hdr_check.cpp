#include "render/hdr_check.h"

#include <cstdint>
#include <cstdio>
#include <string_view>

namespace softreel::render {
namespace {

constexpr int kShortestRow = 8, kLongestRow = 32768;  // of run-length encoded rows [pixels]
constexpr int kChannels = 4;                          // red, green, blue, exponent

const char* const kCutShort = "its pixels end too early";

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }
  int peek(std::size_t at) const { return at < bytes_.size() ? static_cast<int>(bytes_[at]) : -1; }
  bool skip(std::size_t count) {
    if (count > bytes_.size()) return false;
    bytes_ = bytes_.subspan(count);
    return true;
  }
  std::string_view line() {
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    const std::string_view found = text.substr(0, text.find('\n'));
    skip(found.size() < text.size() ? found.size() + 1 : found.size());
    return found;
  }

 private:
  std::span<const std::byte> bytes_;
};

/// One channel of one row.
std::string row_damage(Reader& in, int width) {
  for (int done = 0; done < width;) {
    const int count = in.peek(0);
    if (count < 0) return kCutShort;
    if (count == 0) return "a run of its pixels has no length";
    const int run = count > 128 ? count - 128 : count;
    if (!in.skip(count > 128 ? 2 : 1 + static_cast<std::size_t>(count))) return kCutShort;
    done += run;
    if (done > width) return "a run of its pixels goes beyond the end of a row";
  }
  return {};
}

}  // namespace

std::string hdr_damage(std::span<const std::byte> bytes) {
  Reader in(bytes);
  const std::string_view magic = in.line();
  if (magic != "#?RADIANCE" && magic != "#?RGBE") return {};
  while (in.left() > 0 && !in.line().empty()) {
  }
  int width = 0, height = 0;
  if (std::sscanf(std::string(in.line()).c_str(), "-Y %9d +X %9d", &height, &width) != 2) return {};
  if (width < 1 || height < 1) return {};
  const std::size_t flat =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(kChannels);
  for (int y = 0; y < height; ++y) {
    const bool encoded = width >= kShortestRow && width < kLongestRow && in.peek(0) == 2 && in.peek(1) == 2 &&
                         in.peek(2) >= 0 && in.peek(2) < 128;
    if (!encoded) {
      if (y > 0) return "its rows are encoded in two ways";
      return in.left() < flat ? kCutShort : "";
    }
    if (in.peek(2) * 256 + in.peek(3) != width) return "a row has another width than the picture";
    in.skip(4);
    for (int channel = 0; channel < kChannels; ++channel)
      if (const std::string damage = row_damage(in, width); !damage.empty()) return damage;
  }
  return {};
}

}  // namespace softreel::render
