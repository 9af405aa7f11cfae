#pragma once
// What to say about a key that does not exist.
#include <string>
#include <string_view>
#include <vector>

namespace softreel::assets {

/// `section` is a path of the table ("soft.material", empty at the top), `word` what was written in it: the nearest key
/// there, or the section that the key belongs in, or else what there is.
std::string unknown_key_text(std::string_view section, std::string_view word);

/// Names of the keys of a section, in the order of the table.
std::vector<std::string> key_names(std::string_view section);

}  // namespace softreel::assets
