#pragma once
// Formulas of a scene file, such as "sin(pi*x)*exp(-t)": scalars over space and time.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/mesh.h"

namespace softreel::assets {

/// What is wrong with a formula, and where, for the user; nothing if it is one.
std::optional<std::string> formula_fault(const std::string& text);

/// What formulas are made of, in one line.
const char* formula_help();

/// A formula in x, y, z [m] and t [s] (or a number), understood by muParser. May be called by several threads at a
/// time: each parses it once.
class Formula {
 public:
  /// Throws std::invalid_argument where formula_fault finds something.
  explicit Formula(const std::string& text);

  double operator()(const sim::Vec3& x, double t) const;
  bool uses_time() const { return uses_time_; }  ///< t appears in it
  bool is_zero() const { return zero_; }         ///< it is the number 0

 private:
  std::shared_ptr<const std::string> text_;
  std::uint64_t id_ = 0;  ///< the same for copies
  bool uses_time_ = false, zero_ = false;
};

}  // namespace softreel::assets
