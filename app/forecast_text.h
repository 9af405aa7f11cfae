#pragma once
// A forecast in words.
#include <string>

#include "app/forecast.h"

namespace softreel::app {

/// One sentence: what is wrong, in figures, and the nearest settings that hold. For verdicts other than kHolds.
std::string verdict_sentence(const assets::Scene& scene, const Forecast& forecast);

/// The paragraph that `check` prints, with its last line feed.
std::string forecast_text(const assets::Scene& scene, const sim::Model& model, const Forecast& forecast);

}  // namespace softreel::app
