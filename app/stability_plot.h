#pragma once
// Pictures of stability: a measured map with its forecast, and the regions of the integrators.
#include <string>

#include "app/stability_map.h"
#include "app/study_plot.h"

namespace softreel::app {

/// A cell of colour for each outcome; the forecast limit as a line where x and y are numbers.
StudyPlot stability_plot(const std::string& title, const StabilityMap& map);

/// Where |R(z)| = 1 of every integrator, z = h lambda in the complex plane: of y' = lambda y in its real form
/// x'' + 2 xi omega x' + omega^2 x = 0, whose eigenvalues are lambda and its conjugate. Computed from the methods
/// (sim/stability.h).
StudyPlot regions_plot();

}  // namespace softreel::app
