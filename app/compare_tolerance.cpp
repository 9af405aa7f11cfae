// Tolerances as they are typed.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "app/compare_rules.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;

constexpr const char* kAllowed =
    "bytes, pixels (or same), driver, perceptual, and limits: pixels=0.1%, levels=3, cluster=25%, flip=0.01, "
    "visible=0.2%";

[[noreturn]] void refuse(const std::string& where, const std::string& found) {
  throw UserError(ErrorKind::kUsage, fmt::format("{}: found \"{}\"; allowed are {}", where, found, kAllowed));
}

/// "0.5" or "50%".
std::optional<double> number(std::string_view text) {
  const bool percent = text.ends_with('%');
  if (percent) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return percent ? value / 100 : value;
}

bool set_rung(const std::string& name, render::Tolerance& t) {
  if (name == "bytes")
    t.rung = render::Rung::kBytes;
  else if (name == "pixels" || name == "same")
    t.rung = render::Rung::kPixels;
  else if (name == "driver")
    t.rung = render::Rung::kDriver;
  else if (name == "perceptual")
    t.rung = render::Rung::kPerceptual;
  else
    return false;
  return true;
}

/// False for a key that does not exist and a value out of its range.
bool set_limit(const std::string& key, double value, bool percent, render::Tolerance& t) {
  if (key == "levels") {
    if (percent || value < 0 || value > 255 || value != std::floor(value)) return false;
    t.driver.levels = static_cast<int>(value);
    return true;
  }
  if (value < 0 || value > 1) return false;
  if (key == "pixels")
    t.driver.pixels = value;
  else if (key == "cluster")
    t.driver.cluster = value;
  else if (key == "flip")
    t.perceptual.mean = value;
  else if (key == "visible")
    t.perceptual.visible = value;
  else
    return false;
  return true;
}

}  // namespace

render::Tolerance parse_tolerance(const std::string& text, const render::Tolerance& base, const std::string& where) {
  render::Tolerance t = base;
  bool named = false, of_flip = false;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string part = text.substr(start, end - start);
    start = end + 1;
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) {
      if (named || !set_rung(part, t)) refuse(where, part);
      named = true;
      continue;
    }
    const std::string key = part.substr(0, equals);
    const std::optional<double> value = number(std::string_view(part).substr(equals + 1));
    if (!value || !set_limit(key, *value, part.ends_with('%'), t)) refuse(where, part);
    of_flip = of_flip || key == "flip" || key == "visible";
  }
  if (named) {
    if (of_flip && t.rung != render::Rung::kPerceptual) refuse(where, text);
  } else {
    t.rung = of_flip ? render::Rung::kPerceptual : std::max(t.rung, render::Rung::kDriver);
  }
  return t;
}

}  // namespace softreel::app
