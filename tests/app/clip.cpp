#include "tests/app/clip.h"

#include "render/png.h"

namespace softreel::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSmallPictures = R"(
[render]
size = [48, 32]
samples = 2
)";

std::map<std::string, std::string> files_ending(const fs::path& folder, const std::string& end) {
  std::map<std::string, std::string> files = files_below(folder);
  std::erase_if(files, [&](const auto& file) { return !file.first.ends_with(end); });
  return files;
}

bool is_temporary(const fs::path& file) {
  const std::string name = file.filename().string();
  return name[0] == '.' || contains(name, ".tmp-") || contains(name, ".part");
}

}  // namespace

std::string small_scene() {
  return std::string(R"(
[time]
fps = 30
duration = 0.2667
substeps = 2

[[cloth]]
name = "sheet"
grid = { size = [0.6, 0.6], cells = [8, 8] }
model = "mass-spring"
translate = [0, 0.8, 0]
pins = [{ vertices = [0, 8] }]

[[soft]]
name = "block"
block = { size = [0.3, 0.2, 0.3], cells = [2, 2, 2] }
material = { young = 2e4, poisson = 0.4 }
translate = [0, 0.13, 0]

[[collider]]
name = "ball"
shape = "sphere"
radius = 0.5
friction = 0
translate = [0, -0.5, 0]
)") + kSmallPictures;
}

std::string hanging_cloth() {
  return std::string(R"(
[time]
fps = 30
duration = 0.2
substeps = 2

[[cloth]]
name = "sheet"
grid = { size = [0.6, 0.6], cells = [6, 6] }
model = "mass-spring"
pins = [{ box = [[-1, -1, -0.31], [1, 1, -0.29]] }]

[camera]
position = [1, 0.4, 1.2]
target = [0, -0.2, 0]

[[light]]
position = [2, 3, 1]
radius = 0.3
)") + kSmallPictures +
         "ground = { height = -0.8 }\n";
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file()) files[fs::relative(it->path(), folder).string()] = slurp(it->path());
  return files;
}

std::map<std::string, std::string> pictures_in(const fs::path& folder) { return files_ending(folder, ".png"); }
std::map<std::string, std::string> states_in(const fs::path& folder) { return files_ending(folder, ".state"); }

void check_only_whole_files(const fs::path& folder) {
  for (const auto& [name, bytes] : files_below(folder)) {
    INFO(name);
    CHECK_FALSE(is_temporary(name));
    if (name.ends_with(".png")) CHECK(render::read_png_text(folder / name));
  }
}

nlohmann::json stats_of(std::vector<std::string> arguments, const TempFolder& folder) {
  const fs::path file = folder / "stats.json";
  arguments.insert(arguments.end(), {"--stats", file.string()});
  const RunResult result = run(arguments);
  INFO(result.err);
  CHECK(result.code == 0);
  nlohmann::json json = nlohmann::json::parse(slurp(file), nullptr, false);
  CHECK_FALSE(json.is_discarded());
  return json;
}

}  // namespace softreel::test
