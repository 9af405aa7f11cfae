#pragma once
// A study as one HTML file that needs nothing beside it.
#include <string>
#include <vector>

#include "app/study_reference.h"
#include "app/study_row.h"
#include "app/study_table.h"

namespace softreel::app {

struct ReportPicture {
  std::string caption;
  std::string png;  ///< bytes of the file
};

struct StudyReport {
  StudyHead head;
  std::string lines;                    ///< as on the terminal
  std::vector<std::string> plots;       ///< SVG files, whole
  std::vector<ReportPicture> pictures;  ///< of the best and the worst run
};

/// Plots and pictures inline, the table sortable by a click on its heads (without the script it is a plain table).
std::string study_html(const StudyReport& report, const std::vector<StudyRow>& rows, const StudyReference& reference);

}  // namespace softreel::app
