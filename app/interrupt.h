#pragma once
// Ctrl-C: the work in hand is ended cleanly, what is complete stays.
#include <stdexcept>
#include <string>

namespace softreel::app {

/// Thrown where the work stops; the program ends with exit code 130. Says what remains of the work.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From now on SIGINT and SIGTERM only set a flag; a second one ends the program at once. A signal that was ignored
/// when the program started (nohup, a job in the background) stays ignored.
void catch_interrupts();
/// The command in hand keeps what is complete and goes on from there the next time; Interrupted will say so.
void promise_to_go_on();
bool interrupted();
/// Throws Interrupted if the flag is set.
void stop_if_interrupted();

}  // namespace softreel::app
