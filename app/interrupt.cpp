#include "app/interrupt.h"

#include <csignal>

namespace softreel::app {
namespace {

volatile std::sig_atomic_t flag = 0;
bool goes_on = false;

void on_signal(int signal) {
  if (flag) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  flag = 1;
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);  // a reader of ours that ends early is an error of writing, not a death
}

void promise_to_go_on() { goes_on = true; }

bool interrupted() { return flag != 0; }

void stop_if_interrupted() {
  if (!interrupted()) return;
  throw Interrupted(goes_on ? "interrupted; what is complete is kept, and the same command goes on from there"
                            : "interrupted");
}

}  // namespace softreel::app
