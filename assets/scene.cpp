#include "assets/scene.h"

#include <algorithm>
#include <cmath>

#include "assets/scene_value.h"

namespace softreel::assets {

int Time::frames() const { return std::max(1, static_cast<int>(std::lround(duration * fps))); }

std::filesystem::path Scene::asset_path(const std::string& written) const {
  const std::filesystem::path path(written);
  return path.is_absolute() ? path : (file.parent_path() / path).lexically_normal();
}

double Accuracy::metres() const { return value * metres_per(unit); }

}  // namespace softreel::assets
