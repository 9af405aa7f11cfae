#include "tests/app/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace softreel::test {
namespace {

std::string contents(int fd) {
  std::string text(static_cast<std::size_t>(::lseek(fd, 0, SEEK_END)), '\0');
  const ssize_t n = ::pread(fd, text.data(), text.size(), 0);
  text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return text;
}

std::vector<std::string> changed_environment(const RunOptions& options) {
  std::vector<std::string> result;
  for (char** e = environ; *e; ++e) {
    const std::string entry = *e;
    bool replaced = false;
    for (const auto& [name, value] : options.environment) replaced = replaced || entry.rfind(name + "=", 0) == 0;
    if (!replaced) result.push_back(entry);
  }
  for (const auto& [name, value] : options.environment) result.push_back(name + "=" + value);
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& t : texts) result.push_back(t.data());
  result.push_back(nullptr);
  return result;
}

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

}  // namespace

Running::Running(const std::vector<std::string>& arguments, const RunOptions& options)
    : seconds_(options.seconds), start_(std::chrono::steady_clock::now()) {
  out_ = ::memfd_create("out", MFD_CLOEXEC);
  err_ = ::memfd_create("err", MFD_CLOEXEC);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  const auto stream = [&](int fd, int memory, const std::filesystem::path& file) {
    if (file.empty())
      posix_spawn_file_actions_adddup2(&actions, memory, fd);
    else
      posix_spawn_file_actions_addopen(&actions, fd, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  };
  stream(STDERR_FILENO, err_, options.standard_error);
  if (options.close_standard_output)
    posix_spawn_file_actions_addclose(&actions, STDOUT_FILENO);
  else
    stream(STDOUT_FILENO, out_, options.standard_output);
  if (!options.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());
  // Signals as a shell in the foreground leaves them, whatever started the tests.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t reset, none;
  sigemptyset(&none);
  sigemptyset(&reset);
  for (const int s : {SIGTERM, SIGPIPE, SIGHUP}) sigaddset(&reset, s);
  if (!options.ignore_interrupts) sigaddset(&reset, SIGINT);
  const auto ours = ::signal(SIGINT, options.ignore_interrupts ? SIG_IGN : SIG_DFL);  // inherited
  posix_spawnattr_setsigdefault(&attributes, &reset);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  std::vector<std::string> words = {SOFTREEL_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = changed_environment(options);
  const int error =
      posix_spawn(&pid_, SOFTREEL_PROGRAM, &actions, &attributes, pointers(words).data(), pointers(environment).data());
  ::signal(SIGINT, ours);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::runtime_error("cannot start " SOFTREEL_PROGRAM);
}

Running::~Running() {
  if (!reaped_) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ::close(out_);
  ::close(err_);
}

void Running::send(int signal) const {
  if (!reaped_) ::kill(pid_, signal);
}

bool Running::ended() {
  if (!reaped_) reaped_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
  return reaped_;
}

bool Running::wait_for(const std::function<bool()>& happened) {
  while (!happened()) {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start_;
    if (ended() || since.count() > seconds_) return happened();
    pause();
  }
  return true;
}

RunResult Running::wait() {
  RunResult result;
  wait_for([] { return false; });
  if (!ended()) {
    result.in_time = false;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
    reaped_ = true;
  }
  if (WIFEXITED(status_)) result.code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) result.signal = WTERMSIG(status_);
  result.out = contents(out_);
  result.err = contents(err_);
  return result;
}

RunResult run(const std::vector<std::string>& arguments, const RunOptions& options) {
  return Running(arguments, options).wait();
}

std::vector<int> children_of(int pid) {
  const std::string task = "/proc/" + std::to_string(pid) + "/task/";
  std::vector<int> children;
  std::error_code error;
  for (std::filesystem::directory_iterator it(task, error), end; !error && it != end; it.increment(error)) {
    std::ifstream list(it->path() / "children");
    for (int child; list >> child;) children.push_back(child);
  }
  return children;
}

}  // namespace softreel::test
