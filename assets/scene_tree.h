#pragma once
// A scene file as read, before it means anything: tables, arrays and values that know where they stand. Keeps the TOML
// library out of everything else, and lets overrides be mixed in with their own origin.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softreel::assets {

/// Origin of a node: a place in a file, or the text of an override.
struct Where {
  std::string file;
  int line = 0, column = 0;  ///< 1-based; 0: unknown
};

struct Node {
  enum class Kind { kBool, kInteger, kFloat, kString, kDate, kArray, kTable };

  std::string key;  ///< in a table
  Where key_where;
  Where where;
  Kind kind = Kind::kTable;
  bool boolean = false;
  int64_t integer = 0;
  double number = 0;
  std::string text;
  std::vector<Node> children;  ///< of an array or table, in the order of the file

  bool is_table() const { return kind == Kind::kTable; }
  bool is_array() const { return kind == Kind::kArray; }
  bool is_number() const { return kind == Kind::kInteger || kind == Kind::kFloat; }
  double as_double() const { return kind == Kind::kInteger ? static_cast<double>(integer) : number; }
  /// Of a table; null when it has no such key.
  const Node* find(std::string_view name) const;
  Node* find(std::string_view name);
  /// Child of a table, by key, or of an array, by number from 1 or by the text under its `name`; null when there is
  /// none.
  const Node* step(std::string_view part) const;
  /// "the string "abc"", "an array of 3 values": for messages.
  std::string found() const;
};

/// Throws UserError (kUsage) with the position when the text is not TOML (UTF-8).
Node parse_toml(std::string_view text, const std::string& file);

/// A value on a command line: TOML, or else the text itself. Throws UserError (kUsage) when it starts like an array,
/// table or quoted string and is none. All of it stands at `where`.
Node parse_override_value(const std::string& text, const Where& where);

/// A bare value as the table it stands for, with a copy under each of `keys`: `look = "red"` as `look = { color = "red"
/// }`. Tables come back as they are, and so does everything when there are no keys.
Node expand_bare(const Node& node, const std::vector<std::string>& keys);

}  // namespace softreel::assets
