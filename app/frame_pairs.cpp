#include "app/frame_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "assets/error.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;
using assets::ErrorKind;
using assets::UserError;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_picture(const fs::path& file) {
  static const std::set<std::string> kExtensions = {".png", ".jpg", ".jpeg", ".bmp", ".tga"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  // NAME.actual.png is what an earlier comparison left beside a missing reference.
  return kExtensions.count(extension) > 0 && file.filename().string()[0] != '.' && file.stem().extension() != ".actual";
}

/// NAME.actual.png: what an earlier comparison left beside a missing reference.
bool is_left_over(const std::string& name) { return fs::path(name).stem().extension() == ".actual"; }

/// Pictures in a folder, left-overs included, in no order.
std::vector<std::string> all_pictures_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    // A link that leads nowhere is a picture that is to be read, and will be told.
    std::error_code ignored;
    const bool file = it->is_regular_file(ignored) || it->is_symlink(ignored);
    if (file && !it->is_directory(ignored) && is_picture(it->path())) names.push_back(it->path().filename().string());
  }
  if (error) throw UserError(ErrorKind::kInput, folder.string(), "cannot be read: " + error.message());
  return names;
}

/// Runs of digits by their value, everything else by its bytes.
bool by_number(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto digits = [](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t start = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(start, at - start);
    };
    const std::string x = digits(a, i), y = digits(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // 01 and 1: never equal
}

}  // namespace

int number_in(const std::string& name) {
  const std::string stem = fs::path(name).stem().string();
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  std::size_t start = end;
  while (start > 0 && is_digit(stem[start - 1])) --start;
  return end == start || end - start > 9 ? -1 : std::stoi(stem.substr(start, end - start));
}

std::vector<std::string> pictures_in(const fs::path& folder) {
  std::vector<std::string> names = all_pictures_in(folder);
  std::erase_if(names, is_left_over);
  std::sort(names.begin(), names.end(), by_number);
  return names;
}

bool names_folder(const fs::path& path, std::size_t pictures) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return fs::is_directory(path, ignored);
  return pictures > 1 || !path.has_extension();
}

std::vector<FramePair> pair_frames(const fs::path& reference, const fs::path& actual, bool make_references) {
  const std::vector<std::string> references = pictures_in(reference), actuals = pictures_in(actual);
  constexpr const char* kNone = "there is no picture in this folder (.png, .jpg, .jpeg, .bmp, .tga)";
  if (references.empty() && !make_references && all_pictures_in(reference).empty())
    throw UserError(ErrorKind::kInput, reference.string(), kNone);
  if (actuals.empty()) throw UserError(ErrorKind::kInput, actual.string(), kNone);
  std::error_code ignored;
  if (fs::equivalent(reference, actual, ignored))
    throw UserError(ErrorKind::kUsage, fmt::format("{} and {} are the same folder; nothing is compared with itself",
                                                   reference.string(), actual.string()));
  std::vector<FramePair> pairs;
  std::size_t i = 0, j = 0;
  while (i < references.size() || j < actuals.size()) {
    const bool both = i < references.size() && j < actuals.size() && references[i] == actuals[j];
    const bool left = both || j == actuals.size() || (i < references.size() && by_number(references[i], actuals[j]));
    FramePair pair;
    pair.name = left ? references[i] : actuals[j];
    pair.number = number_in(pair.name);
    if (left) pair.reference = reference / references[i++];
    if (!left || both) pair.actual = actual / actuals[j++];
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace softreel::app
