#pragma once
// Content decides what is up to date: XXH3 with 128 bits (https://xxhash.com), written as 32 hexadecimal digits.
// Not cryptographic: it tells files apart, it does not defend against forgery.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace softreel::assets {

/// Hash of a sequence of values. Every `add` also counts its length, so ("ab", "c") and ("a", "bc") differ.
class ContentHasher {
 public:
  ContentHasher();
  ~ContentHasher();
  ContentHasher(ContentHasher&&) noexcept;
  ContentHasher& operator=(ContentHasher&&) noexcept;

  ContentHasher& add_bytes(const void* data, std::size_t bytes);
  ContentHasher& add(std::string_view text) { return add_bytes(text.data(), text.size()); }
  ContentHasher& add(const char* text) { return add(std::string_view(text)); }
  /// Numbers by their bits: 0.0 and -0.0 differ.
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> ContentHasher& add(T value) {
    return add_bytes(&value, sizeof value);
  }
  /// Arrays of numbers, or of structs without padding.
  template <class T>
  ContentHasher& add_span(std::span<const T> values) {
    return add_bytes(values.data(), values.size_bytes());
  }

  std::string hex() const;  ///< 32 lower-case digits; more may be added afterwards

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Hash of a file's bytes. Throws UserError(kInput) when it cannot be read.
std::string hash_file(const std::filesystem::path& file);

/// 64-bit XXH3, the checksum of this project's own binary files.
std::uint64_t checksum64(std::string_view bytes);

}  // namespace softreel::assets
