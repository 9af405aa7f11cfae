#pragma once
// Ctrl-C: the work in hand is ended cleanly, what is complete stays.
#include <stdexcept>

namespace softreel::app {

/// Thrown where the work stops; the program ends with exit code 130.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on SIGINT and SIGTERM only set a flag; a second one ends the program at once.
void catch_interrupts();
bool interrupted();
/// Throws Interrupted if the flag is set.
void stop_if_interrupted();

}  // namespace softreel::app
