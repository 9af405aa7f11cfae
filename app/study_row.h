#pragma once
// One line of a study's table.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/study_measures.h"

namespace softreel::app {

struct StudyRow {
  std::string method, label, integrator;                      ///< as StudyVariant
  std::vector<std::pair<std::string, std::string>> settings;  ///< as StudyVariant
  bool present = false;                                       ///< what the scene uses now
  double step = 0;                                            ///< [s]

  bool run = false;                      ///< it was tried; otherwise the budget was over before
  std::optional<TrialFailure> failure;   ///< also of what was not tried
  std::optional<PositionErrors> errors;  ///< of runs that came to the end
  Drifts drifts;
  std::vector<double> energy;  ///< change of the total energy at each frame [J], as far as it came

  int repeats = 0;
  double wall = 0, processor = 0;  ///< of the simulation alone, median of the repeats [s]
  double setup = 0;                ///< before the first step [s]
  sim::StageSeconds stages;        ///< of the repeat with the median wall time [s]
  long steps = 0, newton = 0, linear = 0, retries = 0;
  long peak_memory = 0;  ///< [bytes]
  long vertices = 0;

  bool done() const { return errors.has_value(); }
  /// Why there are no errors, in a word or two for a table; empty: there are.
  std::string status() const;
};

/// Rows that are done or failed, kept one file each, so that an interrupted study goes on.
class StudyStore {
 public:
  explicit StudyStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws UserError (kOutput). `last`: state of the last frame, for a picture; null: none.
  void write(const std::string& hash, const StudyRow& row, const CachedFrame* last) const;
  /// Fills what was measured; false if there is no whole row of that hash.
  bool read(const std::string& hash, StudyRow& row) const;
  std::optional<CachedFrame> last_frame(const std::string& hash) const;

 private:
  std::filesystem::path folder_;
};

/// The measured part of a row, as JSON text and back; false for a text that is none.
std::string row_json(const StudyRow& row);
bool parse_row_json(const std::string& text, StudyRow& row);

}  // namespace softreel::app
