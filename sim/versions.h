#pragma once
// Versions of the libraries behind this folder, for --version.
#include <string>

namespace softreel::sim {

std::string cholmod_version();

}  // namespace softreel::sim
