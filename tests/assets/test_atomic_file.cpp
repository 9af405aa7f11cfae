#include <sys/resource.h>

#include <csignal>

#include "assets/atomic_file.h"
#include "assets/content_hash.h"
#include "tests/assets/support.h"

using namespace softreel;
using assets::ErrorKind;

TEST_CASE("A file appears with commit and leaves nothing beside it") {
  test::TempFolder folder;
  {
    assets::AtomicFile file(folder / "a.bin");
    file.write("half");
    CHECK_FALSE(std::filesystem::exists(folder / "a.bin"));
    file.write(" and half");
    file.commit(true);
  }
  CHECK(test::slurp(folder / "a.bin") == "half and half");
  CHECK(folder.files() == 1);
}

TEST_CASE("A file that is given up leaves the old one as it was") {
  test::TempFolder folder;
  folder.write("a.bin", "old");
  { assets::AtomicFile(folder / "a.bin").write("new"); }
  CHECK(test::slurp(folder / "a.bin") == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE("A link is followed, not replaced") {
  test::TempFolder folder;
  folder.write("real.bin", "old");
  std::filesystem::create_symlink("real.bin", folder / "link.bin");
  assets::write_file_atomically(folder / "link.bin", "new");
  CHECK(std::filesystem::is_symlink(folder / "link.bin"));
  CHECK(test::slurp(folder / "real.bin") == "new");
}

TEST_CASE("Targets that cannot be written are clear errors") {
  test::TempFolder folder;
  folder.write("file", "x");
  for (const auto& [target, reason] :
       std::map<std::string, std::string>{{(folder / "none/a").string(), "No such file"},
                                          {(folder / "file/a").string(), "Not a directory"},
                                          {folder.path().string(), "is a folder"},
                                          {"/dev/null", "no regular file"}}) {
    const std::string text =
        test::user_error(ErrorKind::kOutput, [&, t = target] { assets::write_file_atomically(t, "x"); });
    CHECK_MESSAGE(test::contains(text, reason), text);
  }
  const std::string text = test::user_error(ErrorKind::kOutput, [&] { assets::make_folders(folder / "file/sub"); });
  CHECK_MESSAGE(test::contains(text, "cannot be made"), text);
}

TEST_CASE("A disk that takes no more is an error and leaves no partial file") {
  test::TempFolder folder;
  rlimit old = {};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {100000, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string text = test::user_error(
      ErrorKind::kOutput, [&] { assets::write_file_atomically(folder / "big.bin", std::string(5000000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  CHECK_MESSAGE(test::contains(text, "cannot be written"), text);
  CHECK(folder.files() == 0);
}

TEST_CASE("Files that cannot be read are clear errors") {
  test::TempFolder folder;
  folder.write("a", "12345");
  CHECK(assets::read_file(folder / "a") == "12345");
  CHECK(test::contains(test::user_error(ErrorKind::kInput, [&] { assets::read_file(folder / "a", 4); }), "5 bytes"));
  CHECK(test::contains(test::user_error(ErrorKind::kInput, [&] { assets::read_file(folder / "b"); }), "No such file"));
  CHECK(test::contains(test::user_error(ErrorKind::kInput, [&] { assets::read_file(folder.path()); }), "folder"));
}

TEST_CASE("The content hash is XXH3 with 128 bits and tells sequences apart") {
  using assets::ContentHasher;
  CHECK(ContentHasher().hex() == "99aa06d3014798d86001c324468d497f");  // of no bytes, published with xxHash
  CHECK(ContentHasher().add("ab").add("c").hex() != ContentHasher().add("a").add("bc").hex());
  CHECK(ContentHasher().add(0.0).hex() != ContentHasher().add(-0.0).hex());
  const std::vector<double> values = {1, 2};
  CHECK(ContentHasher().add_span(std::span(values)).hex() == ContentHasher().add_bytes(values.data(), 16).hex());
  test::TempFolder folder;
  const auto file = folder.write("a", "content");
  CHECK(assets::hash_file(file) == ContentHasher().add("content").hex());
}
