#pragma once
// Flat binary blobs: what goes to and from workers, and into this project's own cache files. Native byte order: a blob
// never leaves the machine that wrote it.
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace softreel::assets {

/// A blob that ends early or promises more than it holds.
struct BrokenBlob : std::runtime_error {
  BrokenBlob() : std::runtime_error("broken blob") {}
};

class BlobWriter {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void text(std::string_view s) {
    value<std::uint64_t>(s.size());
    bytes.append(s);
  }
  /// Elements whose bytes are their value (numbers, Eigen's fixed vectors, std::array of numbers).
  template <class T>
  void array(const std::vector<T>& v) {
    value<std::uint64_t>(v.size());
    bytes.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T));
  }
  std::string bytes;
};

class BlobReader {
 public:
  explicit BlobReader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T v;
    std::memcpy(&v, take(sizeof v).data(), sizeof v);
    return v;
  }
  std::string text() { return std::string(take(count(1))); }
  template <class T>
  std::vector<T> array() {
    const std::size_t n = count(sizeof(T));
    std::vector<T> v(n);
    const std::string_view bytes = take(n * sizeof(T));
    if (n > 0) std::memcpy(static_cast<void*>(v.data()), bytes.data(), bytes.size());
    return v;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  // Held against what is there before anybody allocates.
  std::size_t count(std::size_t element_bytes) {
    const auto n = value<std::uint64_t>();
    if (n > rest_.size() / element_bytes) throw BrokenBlob();
    return static_cast<std::size_t>(n);
  }
  std::string_view take(std::size_t n) {
    if (n > rest_.size()) throw BrokenBlob();
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }
  std::string_view rest_;
};

}  // namespace softreel::assets
