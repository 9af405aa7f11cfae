#pragma once
// The program itself, run as a user runs it.
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace softreel::test {

struct RunOptions {
  std::filesystem::path folder = {};                               ///< working directory; empty: ours
  std::vector<std::pair<std::string, std::string>> environment{};  ///< changed or added
  std::filesystem::path standard_output = {};                      ///< a file instead of RunResult::out
  std::filesystem::path standard_error = {};                       ///< a file instead of RunResult::err
  bool close_standard_output = false;
  bool ignore_interrupts = false;  ///< SIGINT, as for a job in the background of a script
  double seconds = 240;            ///< time limit: generous, for machines with other work to do
};

struct RunResult {
  int code = -1;         ///< exit code; -1 when a signal ended it
  int signal = 0;        ///< that ended it
  bool in_time = true;   ///< otherwise it was killed at the time limit
  std::string out, err;  ///< what it printed
};

/// A run in the background; the destructor kills what still runs.
class Running {
 public:
  Running(const std::vector<std::string>& arguments, const RunOptions& options = {});
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  int pid() const { return pid_; }
  void send(int signal) const;
  bool ended();
  /// Waits until `happened`, or the program's end or time limit. False if it did not happen.
  bool wait_for(const std::function<bool()>& happened);
  RunResult wait();

 private:
  int pid_ = -1, out_ = -1, err_ = -1, status_ = 0;
  bool reaped_ = false;
  double seconds_;
  std::chrono::steady_clock::time_point start_;
};

RunResult run(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Processes that `pid` has started and that still run.
std::vector<int> children_of(int pid);

}  // namespace softreel::test
