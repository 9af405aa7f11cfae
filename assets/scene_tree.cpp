#include "assets/scene_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace softreel::assets {

const Node* Node::find(std::string_view name) const {
  if (!is_table()) return nullptr;
  const auto it = std::find_if(children.begin(), children.end(), [&](const Node& n) { return n.key == name; });
  return it == children.end() ? nullptr : &*it;
}

Node* Node::find(std::string_view name) { return const_cast<Node*>(static_cast<const Node*>(this)->find(name)); }

const Node* Node::step(std::string_view part) const {
  if (is_table()) return find(part);
  if (!is_array()) return nullptr;
  for (const Node& child : children) {
    const Node* name = child.find("name");
    if (name && name->kind == Kind::kString && name->text == part) return &child;
  }
  size_t position = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), position);
  if (error != std::errc() || end != part.data() + part.size()) return nullptr;
  return position >= 1 && position <= children.size() ? &children[position - 1] : nullptr;
}

std::string Node::found() const {
  switch (kind) {
    case Kind::kBool:
      return boolean ? "true" : "false";
    case Kind::kInteger:
      return fmt::format("{}", integer);
    case Kind::kFloat:
      return fmt::format("{}", number);
    case Kind::kDate:
      return "a date or time";
    case Kind::kArray:
      return children.empty() ? "an empty array" : fmt::format("an array of {}", children.size());
    case Kind::kTable:
      return "a table { ... }";
    case Kind::kString:
      break;
  }
  // Cut at a character's first byte, so that what is left is still UTF-8.
  constexpr size_t kShown = 60;
  if (text.size() <= kShown) return fmt::format("the string \"{}\"", text);
  size_t end = kShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return fmt::format("the string \"{}...\"", std::string_view(text).substr(0, end));
}

Node expand_bare(const Node& node, const std::vector<std::string>& keys) {
  if (node.is_table() || keys.empty()) return node;
  Node table;
  table.key = node.key;
  table.key_where = node.key_where;
  table.where = node.where;
  for (const std::string& key : keys) {
    Node& child = table.children.emplace_back(node);
    child.key = key;
    child.key_where = node.where;
  }
  return table;
}

}  // namespace softreel::assets
