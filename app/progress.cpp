#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace softreel::app {
namespace {

constexpr double kRedraw = 0.1;     // [s] between two drawings of the bar
constexpr double kPlainLine = 5.0;  // [s] between two plain lines

// Remarks that nobody can read (stderr is full or closed) must not end the work: no fmt::print, which throws.
void put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s < 3600 ? fmt::format("{}:{:02d}", s / 60, s % 60)
                  : fmt::format("{}:{:02d}:{:02d}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

Progress::Progress(std::string what, int total, bool quiet, std::string unit)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      quiet_(quiet || total <= 0),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_drawn_(start_) {}

Progress::~Progress() {
  if (!quiet_ && terminal_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::advance(int units) {
  done_ += units;
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_drawn_).count();
  if (done_ < total_ && since < (terminal_ ? kRedraw : kPlainLine)) return;
  last_drawn_ = now;
  draw(std::chrono::duration<double>(now - start_).count());
}

void Progress::draw(double seconds) const {
  const double rate = seconds > 0 ? done_ / seconds : 0;
  const std::string left = rate > 0 ? clock_text((total_ - done_) / rate) : "?";
  const std::string figures = fmt::format("{}/{}  {:.1f} {}/s  {} left", done_, total_, rate, unit_, left);
  if (terminal_) {
    constexpr int kWidth = 28;
    const int full = std::clamp(kWidth * done_ / total_, 0, kWidth);
    put(fmt::format("\r{:<10}[{}{}] {}   ", what_, std::string(static_cast<size_t>(full), '#'),
                    std::string(static_cast<size_t>(kWidth - full), '.'), figures));
  } else {
    put(fmt::format("{} {}\n", what_, figures));
  }
}

void say(bool quiet, const std::string& line) {
  if (!quiet) put(line + "\n");
}

}  // namespace softreel::app
