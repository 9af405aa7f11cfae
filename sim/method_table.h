#pragma once
// What the tables of methods have in common. An entry of a table has a member `info` (MethodInfo) and whatever makes
// the method.
#include <array>
#include <stdexcept>
#include <string>

#include "sim/catalogue.h"

namespace softreel::sim {

/// The infos of a table with static storage, in its order.
template <const auto& kTable>
Catalogue catalogue_of() {
  static const auto infos = [] {
    std::array<MethodInfo, kTable.size()> all;
    for (size_t i = 0; i < all.size(); ++i) all[i] = kTable[i].info;
    return all;
  }();
  return infos;
}

/// The entry of that name. Throws std::invalid_argument that says what `kind` of thing is unknown and which names there
/// are.
template <class Table>
const auto& find_method(const Table& table, std::string_view name, std::string_view kind) {
  std::string names;
  for (const auto& entry : table) {
    if (entry.info.name == name) return entry;
    names += (names.empty() ? "" : ", ") + std::string(entry.info.name);
  }
  throw std::invalid_argument("unknown " + std::string(kind) + " '" + std::string(name) + "'; there are " + names);
}

}  // namespace softreel::sim
