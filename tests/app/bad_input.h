#pragma once
// One row of the table of bad inputs: what the program has to answer.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/assets/support.h"

namespace softreel::test {

struct BadInput {
  std::string what;                    ///< in words, for the report
  std::vector<std::string> arguments;  ///< of the program
  int code;
  std::vector<std::string> says;  ///< parts of the message
};

/// No crash, no hang, this exit code, a message on stderr that says all of it and nothing of a bug of ours.
inline void check_refused(const BadInput& bad, const RunOptions& options = {}) {
  INFO(bad.what);
  const RunResult result = run(bad.arguments, options);
  INFO(result.err);
  CHECK(result.in_time);
  CHECK(result.signal == 0);
  CHECK(result.code == bad.code);
  CHECK_FALSE(contains(result.err, "bug of ours"));
  for (const std::string& part : bad.says) {
    INFO("expected: " << part);
    CHECK(contains(result.err, part));
  }
}

}  // namespace softreel::test
