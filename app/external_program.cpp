#include "app/external_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

extern char** environ;

namespace softreel::app {
namespace {

constexpr int kPatience = 20;  // [ms] between two calls of `check`

}  // namespace

std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string rest = path ? path : "/usr/bin:/bin";
  while (!rest.empty()) {
    const size_t colon = rest.find(':');
    const std::string file = rest.substr(0, colon) + "/" + name;
    struct stat info {};
    if (stat(file.c_str(), &info) == 0 && S_ISREG(info.st_mode) && access(file.c_str(), X_OK) == 0) return file;
    rest = colon == std::string::npos ? std::string() : rest.substr(colon + 1);
  }
  return {};
}

PipeTo::PipeTo(const std::vector<std::string>& arguments, std::function<void()> check) : check_(std::move(check)) {
  int pipe_ends[2];
  errors_ = memfd_create("stderr", MFD_CLOEXEC);
  if (errors_ < 0 || pipe2(pipe_ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::system_category(), "no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, errors_, STDERR_FILENO);
  // A group of its own: Ctrl-C on the terminal is for us to handle.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const int error = posix_spawnp(&pid_, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(pipe_ends[0]);
  input_ = pipe_ends[1];
  fcntl(input_, F_SETFL, O_NONBLOCK);  // a program that does not read must not hold us up
  if (error != 0) {
    pid_ = -1;
    throw std::system_error(error, std::system_category(), arguments[0] + " does not start");
  }
}

PipeTo::~PipeTo() {
  if (input_ >= 0) close(input_);
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (errors_ >= 0) close(errors_);
}

bool PipeTo::write(const void* data, std::size_t bytes) {
  const auto* p = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t n = ::write(input_, p, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) {
      check_();
      pollfd room{input_, POLLOUT, 0};
      poll(&room, 1, kPatience);
      continue;
    }
    if (n < 0) return false;
    p += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

int PipeTo::finish() {
  if (input_ >= 0) close(input_);
  input_ = -1;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0) {
    check_();
    poll(nullptr, 0, kPatience);
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string PipeTo::complaint() const {
  char text[600];
  const off_t size = lseek(errors_, 0, SEEK_END);
  const ssize_t n = pread(errors_, text, sizeof text,
                          size > static_cast<off_t>(sizeof text) ? size - static_cast<off_t>(sizeof text) : 0);
  std::string result(text, n > 0 ? static_cast<size_t>(n) : 0);
  while (!result.empty() && result.back() == '\n') result.pop_back();
  return result;
}

}  // namespace softreel::app
