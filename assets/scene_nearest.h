#pragma once
// What a misspelt name may have meant.
#include <string>
#include <string_view>
#include <vector>

namespace softreel::assets {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`; upper and lower case count as
/// the same, and so do "-" and "_". O(|a| |b|).
int edit_distance(std::string_view a, std::string_view b);

/// The name that is nearest to `word`, or empty when none is near enough to be meant.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "a, b, c", each in quotes if asked.
std::string join_names(const std::vector<std::string>& names, bool quoted = false);

}  // namespace softreel::assets
