#include "assets/gmsh_stream.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace softreel::assets {

template <class T>
T GmshStream::raw(const char* what) {
  const std::string_view rest = text_.rest();
  if (rest.size() < sizeof(T)) fail(fmt::format("the file ends where {} should follow; it is not complete", what));
  T value;
  std::memcpy(&value, rest.data(), sizeof value);
  text_.jump(text_.position() + sizeof value);
  return value;
}

void GmshStream::read_header() {
  if (text_.peek() != "$MeshFormat") fail("does not begin with $MeshFormat: no Gmsh file of version 2 or 4");
  text_.word("$MeshFormat");
  const std::string version(text_.word("the version"));
  version4_ = version == "4.1";
  if (!version4_ && version != "2" && version != "2.0" && version != "2.1" && version != "2.2") {
    fail(fmt::format("is of Gmsh format {}; 2.2 and 4.1 are read: save it again with -format msh41",
                     version.substr(0, 20)));
  }
  const std::int64_t storage = text_.integer("the file type");
  if (storage != 0 && storage != 1) fail("its file type is neither 0 (ASCII) nor 1 (binary)");
  if (text_.integer("the size of numbers") != 8) fail("its numbers have not 8 bytes");
  binary_ = storage == 1;
  if (binary_) {
    text_.skip_line();
    if (raw<std::int32_t>("the byte order") != 1)
      fail("was written by a machine of another byte order; save it in ASCII");
  }
  end_section("MeshFormat");
}

std::string GmshStream::next_section() {
  if (text_.at_end()) return "";
  const std::string_view word = text_.word("a section");
  if (word.size() < 2 || word[0] != '$') fail("a section ($...) should begin here");
  // Binary data begins right behind the line, and may look like blanks.
  if (binary_) text_.skip_line();
  return std::string(word.substr(1, 60));
}

void GmshStream::end_section(const std::string& name) {
  const std::string wanted = "$End" + name;
  if (text_.word(wanted.c_str()) != wanted) fail(fmt::format("{} should stand here", wanted));
}

void GmshStream::skip_section(const std::string& name) {
  const std::string wanted = "$End" + name;
  const std::size_t found = text_.rest().find(wanted);
  if (found == std::string_view::npos) fail(fmt::format("{} is missing; the file is not complete", wanted));
  text_.jump(text_.position() + found + wanted.size());
}

std::int64_t GmshStream::int32(const char* what) { return binary_ ? raw<std::int32_t>(what) : text_.integer(what); }

std::int64_t GmshStream::size(const char* what) {
  if (!binary_) return text_.integer(what);
  const auto value = raw<std::uint64_t>(what);
  if (value > (std::uint64_t{1} << 53)) fail(fmt::format("{} is {}, which makes no sense", what, value));
  return static_cast<std::int64_t>(value);
}

double GmshStream::number(const char* what) {
  if (!binary_) return text_.number(what);
  const auto value = raw<double>(what);
  if (!std::isfinite(value)) fail(fmt::format("{} is no finite number", what));
  return value;
}

std::size_t GmshStream::count(const char* what, bool wide, std::size_t text_bytes, std::size_t binary_bytes) {
  if (!binary_) return text_.count(what, text_bytes);
  const std::int64_t n = wide ? size(what) : int32(what);
  if (n < 0 || static_cast<std::uint64_t>(n) > text_.rest().size() / binary_bytes) {
    fail(fmt::format("{} is {}, more than the rest of the file can hold; it is broken or not complete", what, n));
  }
  return static_cast<std::size_t>(n);
}

std::size_t GmshStream::text_count(const char* what, std::size_t text_bytes, std::size_t binary_bytes) {
  const std::size_t n = text_.count(what, binary_ ? binary_bytes : text_bytes);
  if (binary_) text_.skip_line();
  return n;
}

}  // namespace softreel::assets
