#pragma once
// Formulas of a scene file, such as "sin(pi*x)*exp(-t)": scalars over space and time.
#include <memory>
#include <optional>
#include <string>

#include "sim/mesh.h"

namespace softreel::assets {

/// What is wrong with a formula, and where, for the user; nothing if it is one.
std::optional<std::string> formula_fault(const std::string& text);

/// What formulas are made of, in one line.
const char* formula_help();

/// A formula in x, y, z [m] and t [s] (or a number), understood by muParser. Copies share what was parsed, and calls
/// are not for two threads at a time.
class Formula {
 public:
  /// Throws std::invalid_argument where formula_fault finds something.
  explicit Formula(const std::string& text);

  double operator()(const sim::Vec3& x, double t) const;
  bool uses_time() const;  ///< t appears in it
  bool is_zero() const;    ///< it is the number 0

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace softreel::assets
