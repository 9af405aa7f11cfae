#include "sim/versions.h"

#include <cholmod.h>

namespace softreel::sim {

std::string cholmod_version() {
  int version[3] = {0, 0, 0};
  ::cholmod_version(version);
  return std::to_string(version[0]) + "." + std::to_string(version[1]) + "." + std::to_string(version[2]);
}

}  // namespace softreel::sim
