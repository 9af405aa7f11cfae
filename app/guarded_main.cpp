#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/arguments.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "assets/error.h"
#include "assets/worker.h"
#include "render/error.h"

namespace softreel::app {
namespace {

int exit_code_of(render::RenderErrorKind kind) {
  switch (kind) {
    case render::RenderErrorKind::kContext:
      return kBadInput;  // a needed program, OSMesa, is unusable
    case render::RenderErrorKind::kInput:
      return kBadInput;
    case render::RenderErrorKind::kOutput:
      return kBadOutput;
  }
  return kOurBug;
}

// Not fmt::print, which throws when stderr cannot be written: nobody would be left to catch that.
void complain(const std::string& what) { std::fputs(("softreel: " + what + "\n").c_str(), stderr); }

/// A standard stream that was closed before we started would lend its number to the next file that is opened, and what
/// is printed would end up in there. Reading from or writing to these is an error, as it should be.
void occupy_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(fd, F_GETFD) < 0) ::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool standard_output_failed() { return std::fflush(stdout) != 0 || std::ferror(stdout) != 0; }

constexpr const char* kNoStandardOutput = "standard output could not be written";

}  // namespace

int guarded_main(int argc, char** argv) {
  occupy_standard_streams();
  if (assets::is_worker(argc, argv)) return assets::worker_main(argc, argv);
  try {
    catch_interrupts();
    const int code = run_command_line(argc, argv);
    // Results go to stdout: a full disk or a closed pipe there is an error like any other.
    if (standard_output_failed()) {
      complain(kNoStandardOutput);
      return kBadOutput;
    }
    return code;
  } catch (const Interrupted& e) {
    complain(e.what());
    return kInterrupted;
  } catch (const assets::UserError& e) {
    for (const assets::Problem& p : e.problems()) complain(p.text());
    return static_cast<int>(e.kind());
  } catch (const render::RenderError& e) {
    complain(e.what());
    return exit_code_of(e.kind());
  } catch (const std::bad_alloc&) {
    complain("not enough memory: a smaller grid, max_volume, picture size or fewer samples need less");
    return kSimulationFailed;
  } catch (const std::system_error& e) {
    if (standard_output_failed()) {
      complain(kNoStandardOutput);
      return kBadOutput;
    }
    complain(fmt::format("the system refuses: {}", e.what()));  // no process, no file descriptor, no such path
    return kBadInput;
  } catch (const std::exception& e) {
    complain(fmt::format("a bug of ours: {}\nPlease report it with the command and the scene file.", e.what()));
    return kOurBug;
  }
}

}  // namespace softreel::app
