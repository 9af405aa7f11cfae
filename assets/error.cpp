#include "assets/error.h"

#include <fmt/format.h>

namespace softreel::assets {
namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += '\n';
    text += p.text();
  }
  return text;
}

}  // namespace

std::string Problem::text() const {
  if (file.empty()) return message;
  if (line == 0) return fmt::format("{}: {}", file, message);
  if (column == 0) return fmt::format("{}:{}: {}", file, line, message);
  return fmt::format("{}:{}:{}: {}", file, line, column, message);
}

UserError::UserError(ErrorKind kind, std::string message)
    : UserError(kind, std::vector<Problem>{{"", 0, 0, std::move(message)}}) {}

UserError::UserError(ErrorKind kind, std::string file, std::string message)
    : UserError(kind, std::vector<Problem>{{std::move(file), 0, 0, std::move(message)}}) {}

UserError::UserError(ErrorKind kind, std::vector<Problem> problems)
    : std::runtime_error(join(problems)), kind_(kind), problems_(std::move(problems)) {}

}  // namespace softreel::assets
