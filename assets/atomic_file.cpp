#include "assets/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "assets/error.h"

namespace softreel::assets {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

std::string reason(int error) { return std::system_category().message(error); }

// Several threads of several processes may write into one folder.
std::string unique_suffix() {
  static std::atomic<unsigned> counter{0};
  return fmt::format(".tmp-{}-{}", static_cast<long>(::getpid()), counter++);
}

void close_quietly(int fd) {
  if (fd >= 0) ::close(fd);
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target) {
  std::error_code ignored;
  // rename() would replace the link instead of what it points at.
  if (std::filesystem::is_symlink(target_, ignored)) {
    const auto real = std::filesystem::weakly_canonical(target_, ignored);
    if (!ignored) target_ = real;
  }
  const auto status = std::filesystem::status(target_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const char* what = std::filesystem::is_directory(status) ? "is a folder" : "is no regular file";
    throw UserError(ErrorKind::kOutput, target.string(), fmt::format("{}; name a file to write", what));
  }
  temporary_ = target_;
  temporary_ += unique_suffix();
  fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail("cannot be written", error);
  }
}

AtomicFile::~AtomicFile() {
  close_quietly(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(const char* what, int error) {
  throw UserError(ErrorKind::kOutput, target_.string(), fmt::format("{}: {}", what, reason(error)));
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  buffer_.append(static_cast<const char*>(data), bytes);
  if (buffer_.size() >= kBufferBytes) flush();
}

void AtomicFile::flush() {
  const char* at = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t n = ::write(fd_, at, left);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("cannot be written", errno);
    at += n;
    left -= static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void AtomicFile::commit(bool sync) {
  flush();
  if (sync && ::fsync(fd_) != 0) fail("cannot be written to the disk", errno);
  // Some file systems report a full disk only here.
  const int closed = ::close(fd_);
  fd_ = -1;
  if (closed != 0) fail("cannot be written", errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be put in place", errno);
  temporary_.clear();
  if (!sync) return;
  const auto folder = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd >= 0) ::fsync(fd);  // best effort: some file systems cannot sync a folder
  close_quietly(fd);
}

void write_file_atomically(const std::filesystem::path& target, std::string_view bytes, bool sync) {
  AtomicFile file(target);
  file.write(bytes);
  file.commit(sync);
}

void make_folders(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error) && !error) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (error) {
    throw UserError(ErrorKind::kOutput, folder.string(),
                    fmt::format("this folder cannot be made: {}", error.message()));
  }
}

std::string read_file(const std::filesystem::path& file, std::size_t limit) {
  const auto refuse = [&](const std::string& why) { throw UserError(ErrorKind::kInput, file.string(), why); };
  // O_NONBLOCK: a named pipe without a writer must not hold the program up before it is recognised as one.
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) refuse(fmt::format("cannot be opened: {}", reason(errno)));
  struct stat info = {};
  ::fstat(fd, &info);
  if (!S_ISREG(info.st_mode)) {
    close_quietly(fd);
    refuse(S_ISDIR(info.st_mode) ? "is a folder; name a file" : "is no regular file");
  }
  if (static_cast<std::size_t>(info.st_size) > limit) {
    close_quietly(fd);
    refuse(fmt::format("has {} bytes; at most {} are read", info.st_size, limit));
  }
  std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t got = 0;
  while (got < bytes.size()) {
    const ssize_t n = ::read(fd, bytes.data() + got, bytes.size() - got);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      close_quietly(fd);
      refuse(fmt::format("cannot be read: {}", reason(error)));
    }
    if (n == 0) break;  // shortened meanwhile
    got += static_cast<std::size_t>(n);
  }
  bytes.resize(got);
  close_quietly(fd);
  return bytes;
}

}  // namespace softreel::assets
