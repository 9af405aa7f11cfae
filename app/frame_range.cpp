#include "app/frame_range.h"

#include <fmt/format.h>

#include <charconv>
#include <set>
#include <string_view>

#include "assets/error.h"

namespace softreel::app {
namespace {

[[noreturn]] void refuse(std::string_view part, const std::string& why) {
  throw assets::UserError(assets::ErrorKind::kUsage,
                          fmt::format("--frames: '{}' {}; allowed are numbers and ranges such as 1-48, 40-, 10-20x2, "
                                      "separated by commas",
                                      part, why));
}

int number(std::string_view digits, std::string_view part) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || digits.empty()) refuse(part, "is not a number");
  if (value < 1) refuse(part, "is below 1, the first frame");
  return value;
}

}  // namespace

std::vector<int> parse_frames(const std::string& text, int last) {
  std::set<int> frames;
  if (text.empty())
    for (int f = 1; f <= last; ++f) frames.insert(f);
  std::string_view rest = text;
  while (!rest.empty() || (!text.empty() && frames.empty())) {
    const size_t comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    const size_t dash = part.find('-');
    if (dash == std::string_view::npos) {
      const int frame = number(part, part);
      if (frame > last) refuse(part, fmt::format("lies behind the last frame, {}", last));
      frames.insert(frame);
    } else {
      const size_t cross = part.find('x', dash);
      const std::string_view to = part.substr(dash + 1, cross == std::string_view::npos ? cross : cross - dash - 1);
      const int first = number(part.substr(0, dash), part);
      const int end = to.empty() ? last : number(to, part);
      const int step = cross == std::string_view::npos ? 1 : number(part.substr(cross + 1), part);
      if (end > last || first > last) refuse(part, fmt::format("goes behind the last frame, {}", last));
      if (first > end) refuse(part, "ends before it begins");
      for (int f = first; f <= end; f += step) {
        frames.insert(f);
        if (f > last - step) break;
      }
    }
    if (comma != std::string_view::npos && rest.empty()) refuse(text, "ends with a comma");
  }
  return {frames.begin(), frames.end()};
}

std::string frame_file_name(int frame, const char* extension) {
  return fmt::format("frame_{:04d}.{}", frame, extension);
}

}  // namespace softreel::app
