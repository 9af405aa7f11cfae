#pragma once
// A study as data: CSV and JSON.
#include <string>
#include <vector>

#include "app/study_reference.h"
#include "app/study_row.h"

namespace softreel::app {

/// What a study is about, for all that is written of it.
struct StudyHead {
  std::string scene, command, machine, versions;
  int threads = 1;
  double budget = 0;    ///< [s]
  std::string warning;  ///< what the reader should know; empty: nothing
};

/// One line for each row, with a line of names before; text quoted after RFC 4180. What a row does not have is empty.
std::string study_csv(const std::vector<StudyRow>& rows, const StudyReference& reference);

std::string study_json(const StudyHead& head, const std::vector<StudyRow>& rows, const StudyReference& reference);

/// The machine that measures: processor and number of its threads.
std::string machine_text();

}  // namespace softreel::app
