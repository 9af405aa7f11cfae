#pragma once
// softreel study --render SCENE: error of pictures against the time they take.
#include "app/arguments.h"

namespace softreel::app {

/// Renders one frame with 1, 2, 4, ..., 256 samples and with the presets, and measures each against
/// 1024 (RMS and FLIP): table, pictures.csv, pictures.json, and a plot where gnuplot is there.
int run_study_render(const StudyArguments& arguments);

}  // namespace softreel::app
