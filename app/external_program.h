#pragma once
// Other programs, started without a shell.
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

namespace softreel::app {

/// Full path of a program found through PATH; empty if there is none.
std::string find_program(const std::string& name);

/// A running program whose standard input we write.
class PipeTo {
 public:
  /// Throws std::system_error when it cannot be started. Its standard output is dropped; what it says on standard
  /// error is kept for messages.
  /// `check` is called again and again while we wait for it; what it throws passes on.
  PipeTo(const std::vector<std::string>& arguments, std::function<void()> check);
  /// Kills it if it still runs.
  ~PipeTo();
  PipeTo(const PipeTo&) = delete;
  PipeTo& operator=(const PipeTo&) = delete;

  /// False if it does not read any more.
  bool write(const void* data, std::size_t bytes);
  /// Closes its input and waits. Returns its exit code, 128 + n if signal n ended it.
  int finish();
  /// The last of what it said on standard error.
  std::string complaint() const;

 private:
  std::function<void()> check_;
  int pid_ = -1, input_ = -1, errors_ = -1;
};

/// A file that a program writes under a temporary name: gone at the end of the scope, unless it was renamed before.
struct RemovedAtEnd {
  const std::filesystem::path& file;
  ~RemovedAtEnd() {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
};

}  // namespace softreel::app
