#include "assets/content_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

#include "assets/atomic_file.h"

namespace softreel::assets {

struct ContentHasher::State {
  State() : xxh(XXH3_createState()) {
    if (!xxh) throw std::bad_alloc();
    XXH3_128bits_reset(xxh);
  }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  XXH3_state_t* xxh;
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>()) {}
ContentHasher::~ContentHasher() = default;
ContentHasher::ContentHasher(ContentHasher&&) noexcept = default;
ContentHasher& ContentHasher::operator=(ContentHasher&&) noexcept = default;

ContentHasher& ContentHasher::add_bytes(const void* data, std::size_t bytes) {
  const std::uint64_t length = bytes;
  XXH3_128bits_update(state_->xxh, &length, sizeof length);
  if (bytes > 0) XXH3_128bits_update(state_->xxh, data, bytes);
  return *this;
}

std::string ContentHasher::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string hash_file(const std::filesystem::path& file) { return ContentHasher().add(read_file(file)).hex(); }

std::uint64_t checksum64(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace softreel::assets
