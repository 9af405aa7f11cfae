#pragma once
// Files that are there completely or not at all: written under a temporary name in the same folder, then renamed.
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace softreel::assets {

/// A file under construction. The destructor removes what was not committed.
/// A target that is a symbolic link is followed; one that exists and is no regular file is refused.
/// Every failure (no folder, no permission, full disk) throws UserError(kOutput) with the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);  ///< appends; buffered
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Flushes and renames to the target. `sync`: also waits until the disk has it (a power cut then finds either file).
  void commit(bool sync = false);

  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  void flush();
  [[noreturn]] void fail(const char* what, int error);

  std::filesystem::path target_, temporary_;
  std::string buffer_;
  int fd_ = -1;
};

/// Writes `bytes` to `target` in one go; see AtomicFile.
void write_file_atomically(const std::filesystem::path& target, std::string_view bytes, bool sync = false);

/// Makes `folder` and its parents; throws UserError(kOutput) where that cannot be.
void make_folders(const std::filesystem::path& folder);

/// The bytes of a regular file. Throws UserError(kInput) when it is missing, a folder, unreadable, or larger than
/// `limit`.
std::string read_file(const std::filesystem::path& file, std::size_t limit = std::size_t{1} << 32);

}  // namespace softreel::assets
