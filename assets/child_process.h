#pragma once
// This program started again as a worker (see worker.h): bytes in, bytes out, a time limit and a memory limit.
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace softreel::assets {

struct ChildLimits {
  double seconds = 60;
  std::size_t memory_bytes = 0;  ///< of address space; 0: no limit. Has no effect under the address sanitizer
  std::function<void()> poll;    ///< called some 50 times a second; what it throws kills the child and passes on
};

struct ChildResult {
  enum class End { kDone, kFailed, kSignal, kTimeout };
  End end = End::kFailed;
  int code = 0;        ///< exit code (kFailed) or signal (kSignal)
  std::string output;  ///< what it wrote, whatever its end

  /// "crashed (signal 11, Segmentation fault)", "took longer than 60 s", ...; for a sentence that starts with the
  /// worker.
  std::string how_it_ended(double seconds) const;
};

/// Runs `task` in a worker with `input` on its standard input. posix_spawn, never fork: the caller may have threads.
/// The worker dies with its parent. Throws std::runtime_error when no process can be started.
ChildResult run_worker(const std::string& task, std::string_view input, const ChildLimits& limits);

/// The process id of the worker that now runs, 0: none. For tests that kill it, and for signal handlers.
int running_worker();

}  // namespace softreel::assets
