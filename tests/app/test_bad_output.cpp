// Output that cannot be written: exit code 5, the path and the system's reason, nothing half-done.
#include <sys/mount.h>
#include <unistd.h>

#include "render/image.h"
#include "render/png.h"
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

/// A small file system of its own, where the tests may mount one.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, const char* size) : folder_(folder) {
    std::filesystem::create_directories(folder);
    mounted_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, (std::string("size=") + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::filesystem::path folder_;
  bool mounted_ = false;
};

}  // namespace

TEST_CASE("Output that cannot be written is refused before the work") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  test::TempFolder other;
  const std::string mesh = other.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  const std::string file = folder.write("file", "a file").string(), out = (folder / "out").string();
  const std::string taken = folder.path().string();
  const std::vector<test::BadInput> table = {
      {"a file where the folder should be", {"render", scene, "-o", file}, 5, {file}},
      {"a file in the way of the folder", {"render", scene, "-o", file + "/out"}, 5, {file}},
      {"a folder that nobody can write into", {"render", scene, "-o", "/proc/softreel"}, 5, {"/proc/softreel"}},
      {"a folder that is there and not writable", {"render", scene, "-o", "/proc/self/fdinfo"}, 5, {"/proc/self"}},
      {"stats into a folder's name", {"render", scene, "-o", out, "--stats", taken}, 5, {"folder"}},
      {"stats where nothing can be", {"render", scene, "-o", out, "--stats", file + "/s.json"}, 5, {file}},
      {"video where nothing can be", {"render", scene, "-o", out, "--video", file + "/a.mp4"}, 5, {file}},
      {"export", {"simulate", scene, "-o", file, "--export", "ply"}, 5, {file}},
      {"turntable", {"turntable", mesh, "-o", file}, 5, {file}},
      {"tetrahedra", {"tetrahedralize", mesh, "-o", file + "/t.msh"}, 5, {file}},
  };
  for (const test::BadInput& bad : table) test::check_refused(bad);
  CHECK(test::states_in(folder.path()).empty());
  CHECK(test::pictures_in(folder.path()).empty());
  CHECK(test::slurp(file) == "a file");
}

TEST_CASE("A full disk ends a run with exit code 5 and nothing half-written, with room it goes on") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  REQUIRE(test::run({"render", scene, "-o", (folder / "reference").string()}).code == 0);
  for (const std::string size : {"12k", "20k", "32k", "40k"}) {
    INFO(size);
    const std::filesystem::path out = folder / ("disk" + size);
    const SmallDisk disk(out, size.c_str());
    if (!disk.mounted()) {
      MESSAGE("skipped: mounting a small disk takes root");
      return;
    }
    const test::RunResult full = test::run({"render", scene, "-o", out.string()});
    INFO(full.err);
    CHECK(full.code == 5);
    CHECK(test::contains(full.err, "No space left"));
    CHECK(test::contains(full.err, out.string()));
    test::check_only_whole_files(out);
    REQUIRE(::mount("tmpfs", out.c_str(), "tmpfs", MS_REMOUNT, "size=4m") == 0);
    CHECK(test::run({"render", scene, "-o", out.string()}).code == 0);
    CHECK(test::pictures_in(out) == test::pictures_in(folder / "reference"));
  }
}

TEST_CASE("A video that does not fit is an error, and the frames stay") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  const std::string out = (folder / "out").string();
  REQUIRE(test::run({"render", scene, "-o", out}).code == 0);
  const SmallDisk disk(folder / "disk", "4k");
  if (!disk.mounted()) {
    MESSAGE("skipped: mounting a small disk takes root");
    return;
  }
  // Larger than the disk whatever the encoder makes of the small pictures: stuffed with another file.
  { std::ofstream(folder / "disk/stuffing") << std::string(4096, 'x'); }
  test::check_refused(
      {"video", {"render", scene, "-o", out, "--video", (folder / "disk/a.mp4").string()}, 5, {"a.mp4"}});
  CHECK(test::pictures_in(out).size() == 6);
  CHECK(test::files_below(folder / "disk").size() == 1);
}

TEST_CASE("Standard output that cannot be written is an error, not a crash") {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check", "--list"}, {"--help"}, {"--version"}}) {
    INFO(command[0]);
    test::RunOptions full;
    full.standard_output = "/dev/full";
    test::check_refused({"full", command, 5, {"standard output"}}, full);
    test::RunOptions closed;
    closed.close_standard_output = true;
    test::check_refused({"closed", command, 5, {"standard output"}}, closed);
  }
}

TEST_CASE("A closed standard output never mixes with the files that are written") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  REQUIRE(test::run({"render", scene, "-o", (folder / "a").string()}).code == 0);
  test::RunOptions closed;
  closed.close_standard_output = true;
  CHECK(test::run({"render", scene, "-o", (folder / "b").string()}, closed).code == 5);
  CHECK(test::pictures_in(folder / "a") == test::pictures_in(folder / "b"));
  CHECK(test::states_in(folder / "a") == test::states_in(folder / "b"));
}

TEST_CASE("Standard error that cannot be written does not stop the work") {
  test::TempFolder folder;
  const std::string scene = folder.write("scene.toml", test::hanging_cloth()).string();
  test::RunOptions full;
  full.standard_error = "/dev/full";
  CHECK(test::run({"render", scene, "-o", (folder / "out").string()}, full).code == 0);
  CHECK(test::run({"render", "none.toml"}, full).code == 3);
}
