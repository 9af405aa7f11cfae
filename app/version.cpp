#include <fmt/format.h>

#include <Eigen/Core>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "app/arguments.h"
#include "app/external_program.h"
#include "assets/tetrahedralize.h"
#include "assets/versions.h"
#include "render/renderer.h"
#include "sim/versions.h"

namespace softreel::app {

std::string version() { return SOFTREEL_VERSION; }

std::string version_text() {
  std::string driver;
  try {
    driver = render::Renderer({16, 16, 1, 0, 0}).driver();
  } catch (const std::exception& e) {
    driver = fmt::format("unusable: {}", e.what());
  }
  std::string text = fmt::format("softreel {}\n", version());
  const auto line = [&](const char* name, const std::string& what) {
    text += fmt::format("  {:<12} {}\n", name, what);
  };
  line("OSMesa", driver);
  line("Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  line("CHOLMOD", sim::cholmod_version());
  line("assimp", assets::assimp_version());
  line("TetGen", assets::has_tetgen() ? "1.5" : "left out of this build");
  line("toml++", assets::toml_version());
  line("muParser", assets::muparser_version());
  line("GLM", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH));
  line("fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  line("json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH));
  const std::string ffmpeg = find_program("ffmpeg");
  line("ffmpeg", ffmpeg.empty() ? "not found (only --video needs it)" : ffmpeg);
  const std::string gnuplot = find_program("gnuplot");
  line("gnuplot", gnuplot.empty() ? "not found (only the plots of study need it)" : gnuplot);
  text.pop_back();
  return text;
}

}  // namespace softreel::app
