#pragma once
// The runs of a study, cheapest first, within a budget.
#include <chrono>
#include <vector>

#include "app/study_reference.h"
#include "app/study_row.h"

namespace softreel::app {

struct StudyPlan {
  const Sweep& sweep;
  const StudyPoints& points;
  const StudyReference& reference;
  const StudyView& view;
  const StudyStore& store;
  std::chrono::steady_clock::time_point end;  ///< when the budget is over
  /// Of runs that take no more than a hundredth of the budget left; runs of milliseconds are repeated more often.
  int repeats = 3;
  bool quiet = false;
};

/// One row for each variant, in the order of the sweep; `hashes`: what each is kept under. Rows that are kept are not
/// run again. What the budget has no time for says so. Throws Interrupted, and what is done is kept.
std::vector<StudyRow> run_variants(const StudyPlan& plan, SharedShapes& shapes, std::vector<std::string>& hashes);

/// What a run will take, from those that are done [s]. `rows` and `variants` alike.
double expected_seconds(const std::vector<StudyVariant>& variants, const std::vector<StudyRow>& rows, size_t which);

}  // namespace softreel::app
