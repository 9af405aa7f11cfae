#pragma once
// What can go wrong outside the program while a picture is made. The app turns the kind into an exit code.
#include <stdexcept>
#include <string>

namespace softreel::render {

enum class RenderErrorKind {
  kContext,  ///< no OSMesa context of the needed version, or a GL call that must work failed
  kInput,    ///< an image to be read is missing or unusable
  kOutput,   ///< an image could not be written
};

class RenderError : public std::runtime_error {
 public:
  RenderError(RenderErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  RenderErrorKind kind() const { return kind_; }

 private:
  RenderErrorKind kind_;
};

}  // namespace softreel::render
