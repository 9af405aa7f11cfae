#include "assets/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assets/error.h"

namespace softreel::assets {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

/// A broken file may be binary, and without an end.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text) {
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  return "'" + text + (word.size() > 40 ? "...'" : "'");
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

void TextScanner::fail(const std::string& message) const {
  throw UserError(ErrorKind::kInput, std::vector<Problem>{{file_, line_, 0, message}});
}

void TextScanner::skip_blanks() {
  while (at_ < text_.size()) {
    if (comment_ != 0 && text_[at_] == comment_) {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else if (blank(text_[at_])) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    } else {
      return;
    }
  }
}

bool TextScanner::at_end() {
  skip_blanks();
  return at_ >= text_.size();
}

std::string_view TextScanner::peek() {
  skip_blanks();
  std::size_t end = at_;
  while (end < text_.size() && !blank(text_[end]) && (comment_ == 0 || text_[end] != comment_)) ++end;
  return text_.substr(at_, end - at_);
}

std::string_view TextScanner::word(const char* what) {
  const std::string_view found = peek();
  if (found.empty()) fail(fmt::format("the file ends where {} should follow; it is not complete", what));
  at_ += found.size();
  return found;
}

double TextScanner::number(const char* what) {
  const std::string_view text = without_plus(word(what));
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range || end != text.data() + text.size() || !std::isfinite(value)) {
    fail(fmt::format("{} stands where {} should be, a finite number", shown(text), what));
  }
  if (error != std::errc()) fail(fmt::format("{} stands where {} should be", shown(text), what));
  return value;
}

std::int64_t TextScanner::integer(const char* what) {
  const std::string_view text = without_plus(word(what));
  constexpr std::int64_t kLimit = std::int64_t{1} << 53;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < -kLimit || value > kLimit) {
    fail(fmt::format("{} stands where {} should be, a whole number", shown(text), what));
  }
  return value;
}

std::size_t TextScanner::count(const char* what, std::size_t bytes_each) {
  const std::int64_t n = integer(what);
  if (n < 0) fail(fmt::format("{} is {}; it cannot be negative", what, n));
  // The last one needs no separator behind it.
  if (static_cast<std::uint64_t>(n) > (text_.size() - at_ + 1) / bytes_each) {
    fail(fmt::format("{} is {}, more than the rest of the file can hold; it is broken or not complete", what, n));
  }
  return static_cast<std::size_t>(n);
}

void TextScanner::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  if (at_ < text_.size()) {
    ++at_;
    ++line_;
  }
}

void TextScanner::jump(std::size_t position) {
  position = std::min(position, text_.size());
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
  at_ = position;
}

}  // namespace softreel::assets
