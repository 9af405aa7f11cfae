#pragma once
// Versions of the libraries behind this folder, for --version.
#include <string>

namespace softreel::assets {

std::string assimp_version();
std::string muparser_version();
std::string toml_version();

}  // namespace softreel::assets
