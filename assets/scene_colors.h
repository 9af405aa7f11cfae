#pragma once
// Colours by name and as "#rrggbb".
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/scene.h"

namespace softreel::assets {

/// "#d9a066", "#fff" or a name; empty when it is none of them.
std::optional<Color> parse_color(std::string_view text);

std::vector<std::string> color_names();

}  // namespace softreel::assets
