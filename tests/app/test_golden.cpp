// Golden frames: the last frame of each scene in tests/golden against the picture beside it. A change that is wanted:
// sh tests/golden/update.sh, look at the pictures, commit them.
#include "tests/app/clip.h"

using namespace softreel;
namespace fs = std::filesystem;

TEST_CASE("The golden scenes look as they did") {
  const fs::path golden = fs::path(SOFTREEL_SOURCE_DIR) / "tests/golden";
  test::TempFolder folder;
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(golden)) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    const fs::path name = entry.path().stem();
    INFO(name.string());
    const test::RunResult render =
        test::run({"render", entry.path().string(), "-o", (folder / name.string()).string()});
    INFO(render.err);
    REQUIRE(render.code == 0);
    const fs::path last = folder / name.string() / std::prev(test::pictures_in(folder / name.string()).end())->first;
    const fs::path reference = fs::path(golden / name).replace_extension(".png");
    const test::RunResult same = test::run({"compare", reference.string(), last.string(), "--tolerance", "driver"});
    INFO(same.out);
    CHECK(same.code == 0);
  }
  CHECK(scenes >= 3);
}
