// softreel bench --features
#include <fmt/format.h>

#include <unistd.h>

#include "app/arguments.h"
#include "app/exit_code.h"
#include "app/feature_bench.h"
#include "app/features.h"

namespace softreel::app {
namespace {

/// A folder of our own, gone at the end.
struct Scratch {
  std::filesystem::path folder = std::filesystem::temp_directory_path() / fmt::format("softreel-bench-{}", ::getpid());
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
};

}  // namespace

int run_bench(const BenchArguments& a) {
  const Scratch scratch;
  const std::vector<FeatureCost> costs = measure_features(scratch.folder, a.repeats, a.threads, a.quiet);
  fmt::print("{}", feature_table(costs));
  return kDone;
}

}  // namespace softreel::app
