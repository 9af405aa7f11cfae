#include "assets/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <atomic>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace softreel::assets {
namespace {

constexpr std::size_t kLongest = 2000;

/// muParser would take "x = 3" for an assignment to x.
std::optional<std::size_t> assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    if (i == 0 || (text[i - 1] != '<' && text[i - 1] != '>' && text[i - 1] != '!')) return i;
  }
  return std::nullopt;
}

std::string fault_text(int position, const std::string& what) {
  return position >= 0 ? fmt::format("at character {}: {}", position + 1, what) : what;
}

std::string fault_text(const mu::Parser::exception_type& error, const std::string& text) {
  const int position = std::min(error.GetPos(), static_cast<int>(text.size()));
  std::string token = error.GetToken();
  token.erase(token.find_last_not_of(" \t\n") + 1);
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return fault_text(position, fmt::format("\"{}\" is unknown", token));
    case mu::ecUNEXPECTED_EOF:
      return fault_text(static_cast<int>(text.size()), "it ends too early");
    case mu::ecMISSING_PARENS:
      return fault_text(position, "a bracket is never closed");
    case mu::ecUNEXPECTED_PARENS:
      return fault_text(position, fmt::format("\"{}\" does not belong here", token));
    default:
      break;
  }
  std::string message = error.GetMsg();
  for (const char* tail : {" found at position", " at expression position", "."})
    message = message.substr(0, message.rfind(tail));  // its own count, from 0
  return fault_text(position, message);
}

/// muParser keeps the variables of a formula in one place, so that every thread needs one of its own.
struct Evaluator {
  mu::Parser parser;
  double x = 0, y = 0, z = 0, t = 0;

  explicit Evaluator(const std::string& text) {
    parser.ClearConst();  // muParser calls them _pi and _e
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    parser.DefineVar("z", &z);
    parser.DefineVar("t", &t);
    parser.SetExpr(text);
  }
};

/// This thread's evaluator of a formula. They live as long as the thread: a scene has a handful.
Evaluator& evaluator(std::uint64_t id, const std::string& text) {
  thread_local std::vector<std::pair<std::uint64_t, std::unique_ptr<Evaluator>>> mine;
  for (auto& [known, found] : mine)
    if (known == id) return *found;
  return *mine.emplace_back(id, std::make_unique<Evaluator>(text)).second;
}

std::atomic<std::uint64_t> next_id = 1;

}  // namespace

const char* formula_help() {
  return "numbers, x, y, z [m], t [s], pi, e, + - * / ^, brackets, < <= > >= == !=, && ||, a ? b : c, sin, cos, tan, "
         "asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln, log2, log10, sqrt, abs, sign, rint, min, max";
}

std::optional<std::string> formula_fault(const std::string& text) {
  if (text.size() > kLongest) return fmt::format("it is longer than {} letters", kLongest);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= 0x80 || (byte < 0x20 && byte != '\t' && byte != '\n') || byte == '"' || byte == 0x7f)
      return fault_text(static_cast<int>(i), "this sign means nothing in a formula");
  }
  if (const auto at = assignment(text))
    return fault_text(static_cast<int>(*at), "\"=\" does not belong here; to compare, write ==");
  try {
    Formula formula(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return std::nullopt;
}

Formula::Formula(const std::string& text) : text_(std::make_shared<const std::string>(text)), id_(next_id++) {
  try {
    Evaluator first(text);
    int results = 0;
    const double* values = first.parser.Eval(results);
    if (results != 1) throw std::invalid_argument(fmt::format("{} values separated by commas; one is needed", results));
    const auto used = first.parser.GetUsedVar();
    uses_time_ = used.contains("t");
    zero_ = used.empty() && values[0] == 0;
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(fault_text(error, text));
  }
}

double Formula::operator()(const sim::Vec3& x, double t) const {
  Evaluator& e = evaluator(id_, *text_);
  e.x = x.x();
  e.y = x.y();
  e.z = x.z();
  e.t = t;
  return e.parser.Eval();
}

}  // namespace softreel::assets
