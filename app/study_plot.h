#pragma once
// Pictures of a study, drawn by gnuplot (http://gnuplot.info).
#include <filesystem>
#include <string>
#include <vector>

#include "app/study_reference.h"
#include "app/study_row.h"

namespace softreel::app {

/// A gnuplot script without its terminal and output.
struct StudyPlot {
  std::string name;  ///< of the files: "error"
  std::string script;
};

/// Error over seconds, both logarithmic; one line for each method with its observed order, failures at the top edge
/// (at the seconds that they would have taken to the end), the reference's own error as a line.
StudyPlot error_plot(const std::string& title, const std::vector<StudyRow>& rows, const StudyReference& reference);

/// Change of the total energy over the clip, of one run for each integrator: that with as many steps as the scene takes
/// now, or the nearest number of them. Empty script: energy is not kept in this scene.
StudyPlot energy_plot(const std::string& title, const std::vector<StudyRow>& rows, const assets::Scene& scene);

/// Draws folder/NAME.svg and NAME.png; files appear whole or not at all. False, and nothing is done, when there is no
/// gnuplot. Throws UserError (kOutput) with what gnuplot says; Interrupted.
bool draw_plot(const StudyPlot& plot, const std::filesystem::path& folder);

}  // namespace softreel::app
