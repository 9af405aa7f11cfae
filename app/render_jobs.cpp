#include "app/render_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "app/external_program.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "assets/error.h"

namespace softreel::app {

void render_in_jobs(const ClipArguments& a, const std::vector<int>& frames) {
  const std::size_t jobs = std::min(static_cast<std::size_t>(a.jobs), frames.size());
  std::vector<std::unique_ptr<PipeTo>> running;
  for (std::size_t job = 0; job < jobs; ++job) {
    std::string mine;
    for (std::size_t i = job; i < frames.size(); i += jobs)
      mine += fmt::format("{}{}", mine.empty() ? "" : ",", frames[i]);
    std::vector<std::string> arguments = {"/proc/self/exe", "render", a.scene,  "--frames", mine,
                                          "--threads",      "1",      "--quiet"};
    if (!a.output.empty()) arguments.insert(arguments.end(), {"-o", a.output});
    for (const std::string& setting : a.overrides) arguments.insert(arguments.end(), {"--set", setting});
    if (a.force) arguments.emplace_back("--force");
    running.push_back(std::make_unique<PipeTo>(arguments, stop_if_interrupted));
  }
  Progress progress("processes", static_cast<int>(jobs), a.quiet);
  for (const auto& process : running) {
    if (const int code = process->finish(); code != 0)
      throw assets::UserError(
          assets::ErrorKind::kOutput,
          fmt::format("a process of --jobs {} ended with exit code {}: {}", a.jobs, code, process->complaint()));
    progress.advance();
  }
}

}  // namespace softreel::app
