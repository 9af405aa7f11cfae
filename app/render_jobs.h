#pragma once
// Several processes that render frames of one clip side by side.
#include <vector>

#include "app/arguments.h"

namespace softreel::app {

/// Renders `frames`, which are simulated already, in a.jobs processes with one llvmpipe thread each: that gives more
/// frames a second than one process with as many threads, and the same bits. Process j takes every jobs-th frame from
/// the j-th on. Throws UserError (kOutput) with what a process complained of; Interrupted.
void render_in_jobs(const ClipArguments& a, const std::vector<int>& frames);

}  // namespace softreel::app
