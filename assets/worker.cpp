#include "assets/worker.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

#include "assets/worker_protocol.h"

namespace softreel::assets {
namespace {

// The address sanitizer reserves terabytes of address space.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

std::string read_all(int fd) {
  std::string bytes;
  char chunk[1 << 16];
  for (;;) {
    const ssize_t n = ::read(fd, chunk, sizeof chunk);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(chunk, static_cast<std::size_t>(n));
  }
}

bool write_all(int fd, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

void become_harmless(int parent, unsigned long long memory_bytes) {
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::prctl(PR_SET_DUMPABLE, 0);
  if (kLimitMemory && memory_bytes > 0) {
    const rlimit memory = {memory_bytes, memory_bytes};
    ::setrlimit(RLIMIT_AS, &memory);
  }
  // Ctrl-C goes to the whole group of processes; the parent decides what it means.
  std::signal(SIGINT, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kWorkerBadTask);  // it died before the line above
}

}  // namespace

bool inside_worker() { return std::getenv(kWorkerVariable) != nullptr; }

bool is_worker(int argc, char** argv) { return argc >= 2 && std::strcmp(argv[1], kWorkerArgument) == 0; }

int worker_main(int argc, char** argv) {
  if (argc != 5) return kWorkerBadTask;
  become_harmless(std::atoi(argv[3]), std::strtoull(argv[4], nullptr, 10));
  // Libraries that print do it to nowhere, not into the result.
  const int output = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  const std::string task = argv[2];
  int code = 0;
  try {
    const std::string input = read_all(STDIN_FILENO);
    std::string result;
    if (task == "import") {
      result = import_task(input);
    } else if (task == "tetgen") {
      result = tetgen_task(input);
    } else if (task == "sleep") {  // for the tests of time limits and killed workers
      ::sleep(600);
    } else {
      code = kWorkerBadTask;
    }
    if (code == 0 && !write_all(output, result)) code = kWorkerOutOfMemory;
  } catch (const std::bad_alloc&) {
    code = kWorkerOutOfMemory;
  } catch (...) {  // TetGen throws integers
    code = kWorkerException;
  }
  // No destructors of foreign libraries: what has corrupted its heap must not crash after a good answer.
  ::_exit(code);
}

}  // namespace softreel::assets
