// The only file that knows the TOML library.
//
// Its assertions are off in every build: `[(` breaks one that a proper error message follows, and without NDEBUG it
// would end the program (3.3, parse_table_header into parse_key).
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_MAX_NESTED_VALUES 32  // a scene needs ten; less depth to recurse into
#define TOML_ENABLE_FORMATTERS 0
#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <tuple>

#include "assets/error.h"
#include "assets/scene_tree.h"

namespace softreel::assets {

namespace {

Where where_of(const toml::source_region& region, const std::string& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Node convert(const toml::node& from, const std::string& file) {
  Node to;
  to.where = where_of(from.source(), file);
  if (const toml::table* table = from.as_table()) {
    to.kind = Node::Kind::kTable;
    for (const auto& [key, value] : *table) {
      Node& child = to.children.emplace_back(convert(value, file));
      child.key = std::string(key.str());
      child.key_where = where_of(key.source(), file);
    }
    // The library keeps tables by alphabet.
    std::stable_sort(to.children.begin(), to.children.end(), [](const Node& a, const Node& b) {
      return std::tie(a.key_where.line, a.key_where.column) < std::tie(b.key_where.line, b.key_where.column);
    });
  } else if (const toml::array* array = from.as_array()) {
    to.kind = Node::Kind::kArray;
    for (const toml::node& value : *array) to.children.push_back(convert(value, file));
  } else if (const auto* text = from.as_string()) {
    to.kind = Node::Kind::kString;
    to.text = text->get();
  } else if (const auto* integer = from.as_integer()) {
    to.kind = Node::Kind::kInteger;
    to.integer = integer->get();
  } else if (const auto* number = from.as_floating_point()) {
    to.kind = Node::Kind::kFloat;
    to.number = number->get();
  } else if (const auto* boolean = from.as_boolean()) {
    to.kind = Node::Kind::kBool;
    to.boolean = boolean->get();
  } else {
    to.kind = Node::Kind::kDate;
  }
  return to;
}

// The library's words, and help with what people trip over.
std::string syntax_text(const toml::parse_error& error) {
  const std::string_view said = error.description();
  std::string text = fmt::format("not valid TOML: {}", said);
  if (said.find("inline table") != said.npos && said.find("\\n") != said.npos)
    text += "; a table in { } has to stay on one line, a longer one is written as a [section]";
  return text;
}

// Number of bytes of the string or comment that begins here; 0 when none does. One that does not end goes to the end.
size_t skipped_length(std::string_view text) {
  if (text.front() == '#') return std::min(text.find('\n'), text.size());
  if (text.front() != '"' && text.front() != '\'') return 0;
  const char quote = text.front();
  const bool multi_line = text.size() >= 3 && text[1] == quote && text[2] == quote;
  const size_t quotes = multi_line ? 3 : 1;
  for (size_t i = quotes; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i, quotes).find_first_not_of(quote) == text.npos && i + quotes <= text.size()) {
      return i + quotes;
    }
  }
  return text.size();
}

// The library descends into the tables of a dotted key by recursion without a limit: a.a.a. ... a thousand times over
// would end the program. A key of that kind is found by its dots, of which a number has one.
void refuse_deep_keys(std::string_view text, const std::string& file) {
  constexpr int kMostDots = 16;
  int dots = 0, line = 1;
  for (size_t i = 0; i < text.size(); ++i) {
    if (const size_t skipped = skipped_length(text.substr(i))) {
      line += static_cast<int>(std::count(text.begin() + i, text.begin() + i + skipped, '\n'));
      i += skipped - 1;
      continue;
    }
    if (std::string_view("=,[]{}\n").find(text[i]) != std::string_view::npos) dots = 0;
    line += text[i] == '\n';
    dots += text[i] == '.';
    if (dots > kMostDots)
      throw UserError(ErrorKind::kUsage,
                      {Problem{file, line, 0, fmt::format("found a key of more than {} parts", kMostDots + 1)}});
  }
}

void place(Node& node, const Where& where) {
  node.where = node.key_where = where;
  for (Node& child : node.children) place(child, where);
}

}  // namespace

Node parse_toml(std::string_view text, const std::string& file) {
  refuse_deep_keys(text, file);
  try {
    return convert(toml::parse(text, std::string_view(file)), file);
  } catch (const toml::parse_error& error) {
    const Where where = where_of(error.source(), file);
    throw UserError(ErrorKind::kUsage, {Problem{file, where.line, where.column, syntax_text(error)}});
  }
}

Node parse_override_value(const std::string& text, const Where& where) {
  std::string reason = "more than one value";
  refuse_deep_keys(text, where.file);
  try {
    const toml::table table = toml::parse("v = " + text);
    if (const toml::node* value = table.get("v"); value && table.size() == 1) {
      Node node = convert(*value, "");
      place(node, where);
      return node;
    }
  } catch (const toml::parse_error& error) {
    reason = std::string(error.description());
  }
  if (!text.empty() && std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
    throw UserError(ErrorKind::kUsage,
                    {Problem{where.file, 0, 0, fmt::format("the value is not valid TOML: {}", reason)}});
  Node node;
  node.kind = Node::Kind::kString;
  node.text = text;
  place(node, where);
  return node;
}

}  // namespace softreel::assets
