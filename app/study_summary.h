#pragma once
// What a study teaches: observed orders, the fastest settings that are good enough.
#include <optional>
#include <string>
#include <vector>

#include "app/study_row.h"

namespace softreel::app {

/// Slope of the error (PositionErrors::worst) over the step, both as logarithms, by least squares over the up to three
/// finest steps at which the error is below a tenth of `size` and above ten times `floor` [m] (and 1e-13 sizes, where
/// rounding begins). Nothing with fewer than two.
std::optional<double> observed_order(const std::vector<StudyRow>& rows, const std::string& method, double floor,
                                     double size);

/// How good is good enough.
struct StudyTarget {
  enum class Kind { kFraction, kPixels, kMetres } kind = Kind::kFraction;
  double value = 0.01;  ///< of the scene's size, pixels or metres

  bool met_by(const StudyRow& row, double size) const;
  std::string text() const;  ///< "1 %", "1 px", "0.001 m"
};

/// "1%", "0.5px", "1mm", "2 cm", "0.01 m". Throws UserError (kUsage).
StudyTarget parse_target(const std::string& text);

/// The row with the least wall time that meets it; null if none does.
const StudyRow* fastest(const std::vector<StudyRow>& rows, const StudyTarget& target, double size);

/// Three lines: the fastest under 1 % of the size, under a pixel, and what the scene uses now.
std::string study_lines(const std::vector<StudyRow>& rows, double size);

/// Done, but better or worse than all others that are; null if none is done.
const StudyRow* best_row(const std::vector<StudyRow>& rows);
const StudyRow* worst_row(const std::vector<StudyRow>& rows);

}  // namespace softreel::app
