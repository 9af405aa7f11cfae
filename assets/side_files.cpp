#include "assets/side_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "assets/atomic_file.h"

namespace softreel::assets {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 1> kPhysics = {"bin"};
constexpr std::array<std::string_view, 15> kPicture = {"mtl", "png",  "jpg",  "jpeg", "bmp", "tga", "tif", "tiff",
                                                       "gif", "webp", "ktx2", "dds",  "hdr", "psd", "exr"};
constexpr std::size_t kLongestName = 1024;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// A file's extension in lower case, without the dot.
std::string extension(const fs::path& file) {
  const std::string text = lower(file.extension().string());
  return text.empty() ? text : text.substr(1);
}

bool is_physics(std::string_view extension) {
  return std::find(kPhysics.begin(), kPhysics.end(), extension) != kPhysics.end();
}

bool is_known(std::string_view extension) {
  return is_physics(extension) || std::find(kPicture.begin(), kPicture.end(), extension) != kPicture.end();
}

/// "a%20b" -> "a b", as the URIs of glTF write it.
std::string percent_decoded(const std::string& text) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : std::tolower(c) - 'a' + 10; };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '%' && i + 2 < text.size() && std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
                      std::isxdigit(static_cast<unsigned char>(text[i + 2]));
    result += code ? static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i];
    if (code) i += 2;
  }
  return result;
}

/// Files name others with the paths of the machine they were made on: as it is, then by its name alone nearby.
std::optional<fs::path> find_nearby(std::string name, const fs::path& folder) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path(name);
  for (const fs::path& candidate : {folder / path, folder / path.filename(), folder / "textures" / path.filename()}) {
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored)) return candidate.lexically_normal();
  }
  return std::nullopt;
}

/// What may be the beginning of a name that ends at `end`: after a quote or a control character, and after each blank
/// in between (options stand before a name, and names may have blanks). The longest first.
std::vector<std::string> names_before(std::string_view bytes, std::size_t end) {
  const auto ends_name = [](char c) { return static_cast<unsigned char>(c) < 32 || c == '"' || c == '\'' || c == '>'; };
  std::vector<std::string> names;
  std::size_t begin = end;
  for (; begin > 0 && end - begin < kLongestName && !ends_name(bytes[begin - 1]); --begin)
    if (bytes[begin - 1] == ' ' && begin < end) names.emplace_back(bytes.substr(begin, end - begin));
  names.emplace_back(bytes.substr(begin, end - begin));
  std::reverse(names.begin(), names.end());
  return names;
}

void add_named_in(const fs::path& file, std::set<fs::path>& found) {
  const std::string bytes = read_file(file);
  const fs::path folder = file.parent_path();
  for (std::size_t dot = bytes.find('.'); dot != std::string::npos; dot = bytes.find('.', dot + 1)) {
    std::size_t end = dot + 1;
    while (end < bytes.size() && end - dot <= 5 && std::isalnum(static_cast<unsigned char>(bytes[end]))) ++end;
    if (!is_known(lower(std::string_view(bytes).substr(dot + 1, end - dot - 1)))) continue;
    for (const std::string& name : names_before(bytes, end)) {
      std::optional<fs::path> side = find_nearby(name, folder);
      if (!side) side = find_nearby(percent_decoded(name), folder);
      if (!side) continue;
      if (found.insert(*side).second && extension(*side) == "mtl") add_named_in(*side, found);
      break;
    }
  }
}

}  // namespace

std::vector<SideFile> side_files(const fs::path& mesh) {
  const std::string ext = extension(mesh);
  if (ext == "node" || ext == "ele") {
    const fs::path other = fs::path(mesh).replace_extension(ext == "node" ? ".ele" : ".node");
    std::error_code ignored;
    return fs::is_regular_file(other, ignored) ? std::vector<SideFile>{{other, true}} : std::vector<SideFile>{};
  }
  std::set<fs::path> found;
  add_named_in(mesh, found);
  std::vector<SideFile> files;
  for (const fs::path& file : found) files.push_back({file, is_physics(extension(file))});
  return files;
}

}  // namespace softreel::assets
