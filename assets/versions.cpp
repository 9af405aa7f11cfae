#include "assets/versions.h"

#include <assimp/version.h>
#include <fmt/format.h>
#include <muParser.h>
#include <toml++/impl/version.h>

namespace softreel::assets {

std::string assimp_version() {
  return fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
}

std::string muparser_version() { return mu::Parser().GetVersion(mu::pviBRIEF); }

std::string toml_version() { return fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH); }

}  // namespace softreel::assets
