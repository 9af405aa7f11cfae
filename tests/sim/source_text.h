#pragma once
// Files of the source tree, as text.
#include <fstream>
#include <sstream>
#include <string>

namespace softreel::tests {

/// `file`: from the top of the source tree. Empty if there is none.
inline std::string source_text(const std::string& file) {
  std::ifstream in(std::string(SOFTREEL_SOURCE_DIR) + "/" + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace softreel::tests
