#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <stdexcept>

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

void complain(const char* what) { fmt::print(stderr, "softreel: {}\n", what); }

}  // namespace

int guarded_main(int argc, char** argv) {
  if (assets::is_worker(argc, argv)) return assets::worker_main(argc, argv);
  try {
    catch_interrupts();
    const int code = run_command_line(argc, argv);
    // Results go to stdout: a full disk or a closed pipe there is an error like any other.
    if (std::fflush(stdout) != 0) {
      complain("standard output could not be written");
      return kBadOutput;
    }
    return code;
  } catch (const Interrupted&) {
    fmt::print(stderr, "\nsoftreel: interrupted; what is complete is kept, the same command goes on from there\n");
    return kInterrupted;
  } catch (const assets::UserError& e) {
    for (const assets::Problem& p : e.problems()) complain(p.text().c_str());
    return static_cast<int>(e.kind());
  } catch (const render::RenderError& e) {
    complain(e.what());
    return exit_code_of(e.kind());
  } catch (const std::bad_alloc&) {
    complain("not enough memory: a smaller grid, max_volume, picture size or fewer samples need less");
    return kSimulationFailed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "softreel: a bug of ours: {}\nPlease report it with the command and the scene file.\n",
               e.what());
    return kOurBug;
  }
}

}  // namespace softreel::app
