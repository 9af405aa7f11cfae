#include "app/study_apply.h"

#include <fmt/format.h>

#include <algorithm>

#include "assets/error.h"
#include "assets/scene_canonical.h"
#include "assets/scene_reader.h"
#include "assets/scene_tree.h"

namespace softreel::app {
namespace {

using assets::Node;

/// Byte offset of a place in the text; columns count characters, as toml++ does.
size_t offset_of(const std::string& text, const assets::Where& where) {
  size_t at = 0;
  for (int line = 1; line < where.line; ++line) at = text.find('\n', at) + 1;
  for (int column = 1; column < where.column; ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u) ++at;
  }
  return at;
}

/// End of the value that begins at `at`: of a string its second quote, of an array or inline table its bracket.
size_t end_of_value(const std::string& text, size_t at) {
  int depth = 0;
  for (char quote = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quote) {
      if (c == '\\' && quote == '"') ++at;
      if (c == quote) {
        quote = 0;
        if (depth == 0) return at + 1;
      }
      continue;
    }
    if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == '{')
      ++depth;
    else if ((c == ']' || c == '}') && depth > 0) {
      if (--depth == 0) return at + 1;
    } else if (depth == 0 &&
               (c == ',' || c == '}' || c == ']' || c == '#' || c == '\n' || c == '\r' || c == ' ' || c == '\t'))
      return at;
  }
  return at;
}

/// A word without quotes becomes a TOML string; numbers, arrays and booleans stay.
std::string toml_value(const std::string& value) {
  try {
    const assets::Node node = assets::parse_override_value(value, {});
    return node.kind == Node::Kind::kString && !value.starts_with('"') && !value.starts_with('\'') ? "\"" + value + "\""
                                                                                                   : value;
  } catch (const assets::UserError&) {
    return value;
  }
}

std::string set(const std::string& text, const std::string& file, const std::string& key, const std::string& value) {
  const Node root = assets::parse_toml(text, file);
  const Node* table = &root;
  size_t begin = 0;
  std::string path;
  for (size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    const std::string part = key.substr(begin, dot - begin);
    const Node* next = table->step(part);
    if (!next) break;
    table = next;
    begin = dot + 1;
  }
  const std::string rest = key.substr(begin);
  const std::string written = toml_value(value);
  std::string result = text;
  if (const Node* old = table->find(rest)) {
    const size_t at = offset_of(text, old->where);
    return result.replace(at, end_of_value(text, at) - at, written);
  }
  if (table == &root) {  // a table that is not there yet
    const size_t dot = rest.rfind('.');
    if (dot == std::string::npos) return fmt::format("{} = {}\n", rest, written) + result;  // before every table
    if (!result.empty() && result.back() != '\n') result += '\n';
    return result + fmt::format("\n[{}]\n{} = {}\n", rest.substr(0, dot), rest.substr(dot + 1), written);
  }
  const size_t at = offset_of(text, table->where);
  if (at < text.size() && text[at] == '{') {
    const bool empty = table->children.empty();
    return result.insert(at + 1, fmt::format(" {} = {}{}", rest, written, empty ? "" : ","));
  }
  const size_t line = text.find('\n', at);  // after the line of its head
  if (line == std::string::npos) return result + fmt::format("\n{} = {}\n", rest, written);
  return result.insert(line + 1, fmt::format("{} = {}\n", rest, written));
}

}  // namespace

std::string with_settings(const std::string& text, const std::filesystem::path& file,
                          const std::vector<std::pair<std::string, std::string>>& settings) {
  std::string result = text;
  std::vector<std::string> overrides;
  for (const auto& [key, value] : settings) overrides.push_back(key + "=" + value);
  const std::string wanted = assets::canonical_physics(assets::parse_scene(text, file, overrides));
  try {
    for (const auto& [key, value] : settings) result = set(result, file.string(), key, value);
    if (assets::canonical_physics(assets::parse_scene(result, file)) == wanted) return result;
  } catch (const assets::UserError&) {
    // the answer is below: the text that came out is no scene
  }
  throw assets::UserError(assets::ErrorKind::kUsage, file.string(),
                          fmt::format("these settings could not be written into a copy of this file, because of how "
                                      "its tables are laid out; set them by hand: {}",
                                      fmt::join(overrides, ", ")));
}

}  // namespace softreel::app
