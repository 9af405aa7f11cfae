#pragma once
// softreel study --render SCENE: error of pictures against the time they take.
#include "app/arguments.h"

namespace softreel::app {

/// Renders one frame with 1, 2, 4, ..., 256 samples and measures each against 1024: table, CSV, and a plot where
/// gnuplot is there.
int run_study_render(const StudyArguments& arguments);

}  // namespace softreel::app
