#pragma once
// The user's mistakes: one exception type that says what was found, where, what is allowed and what to do.
// Our own mistakes are assertions (std::logic_error), never this type.
#include <stdexcept>
#include <string>
#include <vector>

namespace softreel::assets {

/// Where the mistake lies; the value is the exit code of the program.
enum class ErrorKind {
  kUsage = 2,       ///< command line or scene, a setting that cannot hold included
  kInput = 3,       ///< an input file or a needed program is missing or unusable
  kSimulation = 4,  ///< the simulation failed
  kOutput = 5,      ///< output could not be written
};

/// One thing that is wrong.
struct Problem {
  std::string file;     ///< file or asset it was found in; empty for the command line
  int line = 0;         ///< 1-based; 0: the file as a whole
  int column = 0;       ///< 1-based; 0: the line as a whole
  std::string message;  ///< what was found, what is allowed, what to do

  /// "file:line:column: message", leaving out what is not known.
  std::string text() const;
};

class UserError : public std::runtime_error {
 public:
  UserError(ErrorKind kind, std::string message);
  UserError(ErrorKind kind, std::string file, std::string message);
  /// All problems of one input together; `problems` must not be empty.
  UserError(ErrorKind kind, std::vector<Problem> problems);

  ErrorKind kind() const { return kind_; }
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  ErrorKind kind_;
  std::vector<Problem> problems_;
};

}  // namespace softreel::assets
