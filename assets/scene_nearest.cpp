#include "assets/scene_nearest.h"

#include <algorithm>
#include <cctype>

namespace softreel::assets {

namespace {
char plain(char c) { return c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const size_t n = b.size() + 1;
  std::vector<int> two_before(n), before(n), row(n);
  for (size_t j = 0; j < n; ++j) row[j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    std::swap(two_before, before);
    std::swap(before, row);
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j < n; ++j) {
      const int differs = plain(a[i - 1]) != plain(b[j - 1]);
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + differs});
      if (i > 1 && j > 1 && plain(a[i - 1]) == plain(b[j - 2]) && plain(a[i - 2]) == plain(b[j - 1]))
        row[j] = std::min(row[j], two_before[j - 2] + 1);
    }
  }
  return row[n - 1];
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  constexpr size_t kLongestWord = 100;  // nothing longer is a misspelling
  if (word.size() < 2 || word.size() > kLongestWord) return {};
  std::string nearest;
  int least = static_cast<int>(std::max<size_t>(1, std::min<size_t>(3, word.size() / 3))) + 1;
  for (const std::string& name : names) {
    const int distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  if (!nearest.empty()) return nearest;
  // "neo-hookean" for "stable-neo-hookean": one name inside the other, if only one fits.
  for (const std::string& name : names) {
    const bool inside = word.size() >= 3 && name.size() >= 3 &&
                        (name.find(word) != std::string::npos || word.find(name) != std::string_view::npos);
    if (!inside) continue;
    if (!nearest.empty()) return {};
    nearest = name;
  }
  return nearest;
}

std::string join_names(const std::vector<std::string>& names, bool quoted) {
  std::string out;
  for (const std::string& name : names) {
    if (!out.empty()) out += ", ";
    out += quoted ? '"' + name + '"' : name;
  }
  return out;
}

}  // namespace softreel::assets
