// Runs the scene of each optional feature (app/features.h), one after the other, for valgrind to count what is
// executed.
//   needs --list             the table of features, as JSON
//   needs FOLDER base|pair|all    runs the base scene, it and its implicit sister, or all, each in FOLDER/NUMBER;
//                                 callgrind dumps after each
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <valgrind/callgrind.h>

#include <nlohmann/json.hpp>

#include "app/exit_code.h"
#include "app/features.h"
#include "assets/worker.h"

namespace {

using namespace softreel::app;

nlohmann::json table() {
  nlohmann::json list = nlohmann::json::array();
  for (const Feature& f : features())
    list.push_back({{"name", f.name},
                    {"code", f.code},
                    {"brings", f.brings},
                    {"shares_code", f.shares_code},
                    {"without", f.without},
                    {"stats", f.stats},
                    {"arguments", feature_arguments(&f, "scene.toml")},
                    {"drawn", f.drawn}});
  return {{"base", kBaseFeatures}, {"features", list}};
}

void run(std::vector<std::string> arguments, const char* output) {
  arguments.insert(arguments.begin(), "softreel");
  for (const char* more : {"--threads", "1", "--quiet", "-o", output}) arguments.emplace_back(more);
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  if (const int code = guarded_main(static_cast<int>(argv.size()), argv.data()); code != kDone) {
    fmt::print(stderr, "needs: exit code {} of: {}\n", code, fmt::join(arguments, " "));
    std::exit(1);
  }
}

/// `name`: of the dump.
void measure(const Feature* feature, const std::filesystem::path& folder, bool drawn, const std::string& name) {
  const std::filesystem::path scene = write_feature_scene(feature, folder);
  std::filesystem::current_path(folder);
  std::vector<std::string> arguments = feature_arguments(feature, "scene.toml");
  if (drawn) arguments[0] = "render";
  if (drawn) {
    // Shaders are compiled into Mesa's cache; what its compiler executes is not ours to count.
    CALLGRIND_STOP_INSTRUMENTATION;
    run(arguments, "warm");
  }
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  run(arguments, "out");
  CALLGRIND_DUMP_STATS_AT(name.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (softreel::assets::is_worker(argc, argv)) return softreel::assets::worker_main(argc, argv);
  if (argc == 2 && std::string_view(argv[1]) == "--list") {
    fmt::print("{}\n", table().dump());
    return 0;
  }
  if (argc != 3) {
    fmt::print(stderr, "usage: needs --list | needs FOLDER base|pair|all\n");
    return 2;
  }
  const std::filesystem::path folder = std::filesystem::absolute(argv[1]);
  const bool all = std::string_view(argv[2]) == "all", pair = std::string_view(argv[2]) == "pair";
  int number = 0;
  const auto next = [&] { return folder / std::to_string(number++); };
  measure(nullptr, next(), false, "base");
  for (const Feature& f : features()) {
    const std::filesystem::path place = next();
    if (f.drawn)
      write_feature_scene(&f, place);  // compiling its shaders takes minutes here: it is judged by --stats
    else if (all || (pair && f.name == "implicit steps"))
      measure(&f, place, false, std::string(f.name));
  }
  if (all) measure(nullptr, next(), true, "base, drawn");
  return 0;
}
