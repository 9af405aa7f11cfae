// The only file that knows the TOML library.
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

void place(Node& node, const Where& where) {
  node.where = node.key_where = where;
  for (Node& child : node.children) place(child, where);
}

}  // namespace

Node parse_toml(std::string_view text, const std::string& file) {
  try {
    return convert(toml::parse(text, std::string_view(file)), file);
  } catch (const toml::parse_error& error) {
    const Where where = where_of(error.source(), file);
    throw UserError(ErrorKind::kUsage,
                    {Problem{file, where.line, where.column, fmt::format("not valid TOML: {}", error.description())}});
  }
}

Node parse_override_value(const std::string& text, const Where& where) {
  std::string reason = "more than one value";
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
