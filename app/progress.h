#pragma once
// Progress on stderr: a bar with rate and time left on a terminal, plain lines elsewhere, nothing when quiet.
#include <chrono>
#include <string>

namespace softreel::app {

class Progress {
 public:
  /// `what`: "simulate", "render"; `total`: `unit`s to come.
  Progress(std::string what, int total, bool quiet, std::string unit = "frames");
  /// Ends the line of the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(int units = 1);

 private:
  void draw(double seconds) const;

  using Clock = std::chrono::steady_clock;
  std::string what_, unit_;
  int total_, done_ = 0;
  bool quiet_, terminal_;
  Clock::time_point start_, last_drawn_;
};

/// One line on stderr, unless quiet.
void say(bool quiet, const std::string& line);

}  // namespace softreel::app
