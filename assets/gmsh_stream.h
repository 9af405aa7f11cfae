#pragma once
// Numbers of a Gmsh file, ASCII or binary, behind one face: the formats differ in how a number is stored, not in order.
#include <cstdint>
#include <string>

#include "assets/text_scanner.h"

namespace softreel::assets {

class GmshStream {
 public:
  GmshStream(std::string_view bytes, std::string file) : text_(bytes, std::move(file)) {}

  /// Reads $MeshFormat: version 2.x or 4.1, storage, size of numbers, byte order.
  void read_header();
  bool binary() const { return binary_; }
  bool version4() const { return version4_; }

  /// The name of the next section ("Nodes" for "$Nodes"), empty at the end.
  std::string next_section();
  void end_section(const std::string& name);   ///< expects "$End..." here
  void skip_section(const std::string& name);  ///< goes on behind its "$End..."

  std::int64_t int32(const char* what);  ///< an int: text, or 4 bytes
  std::int64_t size(const char* what);   ///< a size_t: text, or 8 bytes
  double number(const char* what);       ///< finite; text, or 8 bytes
  /// A count of things that take at least so many bytes each; int or size_t by `wide`.
  std::size_t count(const char* what, bool wide, std::size_t text_bytes, std::size_t binary_bytes);
  /// A count in text even in a binary file (version 2), with the end of its line behind it.
  std::size_t text_count(const char* what, std::size_t text_bytes, std::size_t binary_bytes);

  [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

 private:
  template <class T>
  T raw(const char* what);

  TextScanner text_;
  bool binary_ = false, version4_ = false;
};

}  // namespace softreel::assets
