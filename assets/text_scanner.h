#pragma once
// Words and numbers of a text file, with the line for errors.
#include <cstdint>
#include <string>
#include <string_view>

namespace softreel::assets {

/// All failures throw UserError(kInput) with file and line.
class TextScanner {
 public:
  /// `comment`: from this character to the end of the line nothing counts; 0: no comments.
  TextScanner(std::string_view text, std::string file, char comment = 0)
      : text_(text), file_(std::move(file)), comment_(comment) {}

  bool at_end();                            ///< nothing but blanks and comments is left
  std::string_view word(const char* what);  ///< `what` was expected, for the message
  std::string_view peek();                  ///< the next word, empty at the end
  double number(const char* what);          ///< a finite number
  std::int64_t integer(const char* what);   ///< between -2^53 and 2^53
  /// A count of things that take at least `bytes_each` in the rest of the file.
  std::size_t count(const char* what, std::size_t bytes_each);
  void skip_line();

  std::size_t position() const { return at_; }
  void jump(std::size_t position);  ///< forward
  std::string_view rest() const { return text_.substr(at_); }
  int line() const { return line_; }

  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_blanks();

  std::string_view text_;
  std::string file_;
  char comment_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace softreel::assets
