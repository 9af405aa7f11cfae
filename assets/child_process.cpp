#include "assets/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "assets/worker_protocol.h"

extern char** environ;

namespace softreel::assets {
namespace {

std::atomic<int> running{0};

/// Anonymous memory with a file descriptor: nothing to clean up, however either process ends.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("softreel", MFD_CLOEXEC)) {
    if (fd_ < 0) throw std::system_error(errno, std::system_category(), "memfd_create");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int fd() const { return fd_; }

  void fill(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw std::system_error(errno, std::system_category(), "memory for a worker");
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    ::lseek(fd_, 0, SEEK_SET);
  }

  std::string contents() const {
    std::string bytes(static_cast<std::size_t>(std::max<off_t>(0, ::lseek(fd_, 0, SEEK_END))), '\0');
    std::size_t got = 0;
    while (got < bytes.size()) {
      const ssize_t n = ::pread(fd_, bytes.data() + got, bytes.size() - got, static_cast<off_t>(got));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      got += static_cast<std::size_t>(n);
    }
    bytes.resize(got);
    return bytes;
  }

 private:
  int fd_;
};

/// Standard streams of the worker: the two memory files, and errors to nowhere.
class SpawnActions {
 public:
  SpawnActions(int input, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// Kills and reaps a child on every way out that did not see its end.
struct Reaper {
  pid_t pid;
  bool reaped = false;
  ~Reaper() {
    running = 0;
    if (reaped) return;
    ::kill(pid, SIGKILL);
    while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
};

/// Wakes as soon as a child has ended.
class EndOfProcess {
 public:
  explicit EndOfProcess(pid_t pid) : fd_(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0u))) {}
  ~EndOfProcess() {
    if (fd_ >= 0) ::close(fd_);
  }
  EndOfProcess(const EndOfProcess&) = delete;
  EndOfProcess& operator=(const EndOfProcess&) = delete;
  /// Until then, for `longest` at most; where the system has no such descriptors (Linux before 5.3, some sandboxes),
  /// always as long.
  void wait(std::chrono::milliseconds longest) const {
    pollfd end = {fd_, POLLIN, 0};
    ::poll(&end, fd_ >= 0 ? 1 : 0, static_cast<int>(longest.count()));
  }

 private:
  int fd_;
};

/// This program, by its name: under valgrind /proc/self/exe itself is valgrind. When the file was replaced meanwhile,
/// its name leads nowhere ("... (deleted)"), and only the link does.
std::string own_program() {
  constexpr const char* kLink = "/proc/self/exe";
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink(kLink, error);
  return !error && std::filesystem::exists(program, error) ? program.string() : kLink;
}

pid_t spawn(const std::string& task, std::size_t memory_bytes, const SpawnActions& actions) {
  const std::string parent = std::to_string(::getpid());
  const std::string memory = std::to_string(memory_bytes);
  const char* argv[] = {"softreel", kWorkerArgument, task.c_str(), parent.c_str(), memory.c_str(), nullptr};
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A mask blocked by a thread of ours would be inherited.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  std::vector<char*> environment;
  for (char** e = environ; *e; ++e) environment.push_back(*e);
  std::string mark = std::string(kWorkerVariable) + "=1";
  environment.push_back(mark.data());
  // A worker multiplies no matrices, but OpenBLAS would start its threads, which spin for a while.
  std::string one_thread = "OPENBLAS_NUM_THREADS=1";
  environment.push_back(one_thread.data());
  environment.push_back(nullptr);
  pid_t pid = 0;
  const std::string program = own_program();
  const int error =
      posix_spawn(&pid, program.c_str(), actions.get(), &attributes, const_cast<char**>(argv), environment.data());
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::system_error(error, std::system_category(), "a worker process cannot be started");
  return pid;
}

}  // namespace

int running_worker() { return running; }

std::string ChildResult::how_it_ended(double seconds) const {
  switch (end) {
    case End::kDone:
      return "ended";
    case End::kTimeout:
      return fmt::format("took longer than {:g} s and was stopped", seconds);
    case End::kSignal:
      if (code == SIGKILL) return "was killed (by another program, or by the system for want of memory)";
      return fmt::format("crashed (signal {}, {})", code, ::strsignal(code));
    case End::kFailed:
      break;
  }
  if (code == kWorkerOutOfMemory) return "ran out of memory";
  return fmt::format("failed (exit code {})", code);
}

ChildResult run_worker(const std::string& task, std::string_view input, const ChildLimits& limits) {
  using Clock = std::chrono::steady_clock;
  if (inside_worker()) throw std::logic_error("a worker must not start workers: does main() begin with is_worker()?");
  MemoryFile in, out;
  in.fill(input);
  const SpawnActions actions(in.fd(), out.fd());
  const auto start = Clock::now();
  Reaper child{spawn(task, limits.memory_bytes, actions)};
  running = child.pid;
  const EndOfProcess ended(child.pid);

  ChildResult result;
  constexpr std::chrono::milliseconds kPollEvery(20);
  for (;;) {
    int status = 0;
    const pid_t got = ::waitpid(child.pid, &status, WNOHANG);
    if (got == child.pid) {
      child.reaped = true;
      if (WIFSIGNALED(status)) {
        result.end = ChildResult::End::kSignal;
        result.code = WTERMSIG(status);
      } else {
        result.code = WEXITSTATUS(status);
        result.end = result.code == 0 ? ChildResult::End::kDone : ChildResult::End::kFailed;
      }
      break;
    }
    if (got < 0 && errno != EINTR) throw std::system_error(errno, std::system_category(), "waitpid");
    if (std::chrono::duration<double>(Clock::now() - start).count() > limits.seconds) {
      result.end = ChildResult::End::kTimeout;
      return result;
    }
    if (limits.poll) limits.poll();
    ended.wait(kPollEvery);
  }
  result.output = out.contents();
  return result;
}

}  // namespace softreel::assets
