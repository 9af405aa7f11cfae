#pragma once
// What is known to make scenes fail, looked for in a scene before it runs.
#include <string>
#include <vector>

#include "app/forecast.h"
#include "app/forecast_meetings.h"
#include "app/shapes.h"
#include "assets/scene.h"

namespace softreel::app {

/// Each a sentence with names, figures and what to do; none for most scenes. `forecast`: null for "static".
std::vector<std::string> warnings_of(const assets::Scene& scene, const Shapes& shapes, const sim::Model& model,
                                     const Forecast* forecast);

// Its parts, each of which adds to `warnings`.

/// Slivers, Poisson's ratio near 1/2, thickness.
void warn_of_shapes(const assets::Scene& scene, const Shapes& shapes, std::vector<std::string>& warnings);

/// Colliders that slip through a coarse mesh, and round ones that it dips into. `distance`: of contact [m].
void warn_of_gaps(const std::vector<Meeting>& meetings, double distance, std::vector<std::string>& warnings);

/// Speeds, driven and falling, against contact distance, thin colliders and edges; friction of explicit methods. Not
/// for "static".
void warn_of_speeds(const assets::Scene& scene, const std::vector<MovingBody>& bodies,
                    const std::vector<Meeting>& meetings, std::vector<std::string>& warnings);

/// Lamps inside soft bodies.
void warn_of_lights(const assets::Scene& scene, const Shapes& shapes, std::vector<std::string>& warnings);

/// Masses and stiffnesses that differ a lot across a tie.
void warn_of_ratios(const assets::Scene& scene, const sim::Model& model, std::vector<std::string>& warnings);

}  // namespace softreel::app
