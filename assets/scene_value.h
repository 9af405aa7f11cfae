#pragma once
// Values of keys: what is allowed in words, as TOML text, and read from a file.
#include <optional>
#include <string>
#include <vector>

#include "assets/scene_table.h"
#include "assets/scene_tree.h"

namespace softreel::assets {

/// Units that a `unit` key knows by name [m].
double metres_per(std::string_view unit_name);  ///< 0 for an unknown name
std::vector<std::string> unit_names();
/// Units of an Accuracy: those, "px" and "%".
std::vector<std::string> accuracy_units();

/// What a MethodRef chooses from.
std::vector<std::string> method_names(const MethodRef& value);

/// What the key takes: "a number [Pa], above 0"; the range as text may be given.
std::string expected_text(const Key& key, const ValueRef& value, const std::string& range);

/// The value as TOML, numbers with round-trip precision; empty when absent.
std::string value_text(const ValueRef& value);

/// The names that the value is chosen from; empty when it is none of a list.
std::vector<std::string> value_choices(const ValueRef& value);

struct Fault {
  Where where;
  std::string message;  ///< "found ..., expected ..."
};

/// Puts what the node says into the value, or says what is wrong with it and leaves the value alone.
std::optional<Fault> read_value(const Node& node, const Key& key, const ValueRef& value);

}  // namespace softreel::assets
