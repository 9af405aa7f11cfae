#pragma once
// What both sides of a worker agree on.
#include <string>

namespace softreel::assets {

inline constexpr const char* kWorkerArgument = "--softreel-worker";
inline constexpr const char* kWorkerVariable = "SOFTREEL_WORKER";  ///< set in the environment of every worker
inline constexpr int kWorkerBadTask = 120;                         ///< exit code: unknown task or arguments
inline constexpr int kWorkerOutOfMemory = 121;                     ///< exit code: an allocation failed
inline constexpr int kWorkerException = 122;                       ///< exit code: foreign code threw

/// Whether this process is a worker. A main that forgets `is_worker` would otherwise start itself without end.
bool inside_worker();

/// The tasks: input blob to output blob; run in the worker. What they throw becomes an exit code.
std::string import_task(const std::string& input);
std::string tetgen_task(const std::string& input);

}  // namespace softreel::assets
