// What a second run does again, and what it does not.
#include "tests/app/clip.h"

using namespace softreel;

namespace {

struct Work {
  int simulated = 0, rendered = 0;
  bool operator==(const Work&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Work& work) {
  return out << work.simulated << " simulated, " << work.rendered << " rendered";
}

class Clip {
 public:
  explicit Clip(const std::string& text) { scene = folder.write("scene.toml", text); }

  Work render(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"render", scene.string(), "-o", out().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const nlohmann::json stats = test::stats_of(arguments, folder);
    return {stats.value("frames_simulated", -1), stats.value("frames_rendered", -1)};
  }
  std::filesystem::path out() const { return folder / "out"; }

  test::TempFolder folder;
  std::filesystem::path scene;
};

const std::string kTriangle = "v -1 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n";

}  // namespace

TEST_CASE("A second render does nothing, a picture that is gone or damaged is drawn again, to the same bytes") {
  const Clip clip(test::hanging_cloth());
  CHECK(clip.render() == Work{6, 6});
  const auto before = test::pictures_in(clip.out());
  CHECK(clip.render() == Work{0, 0});
  std::filesystem::remove(clip.out() / "frame_0004.png");
  std::ofstream(clip.out() / "frame_0002.png", std::ios::binary) << before.at("frame_0002.png").substr(0, 300);
  CHECK(clip.render() == Work{0, 2});
  CHECK(test::pictures_in(clip.out()) == before);
}

TEST_CASE("A frame that is drawn alone has the bytes that it has in the whole clip") {
  for (const std::string& text : {test::hanging_cloth(), test::small_scene()}) {
    const Clip clip(text), part(text);
    clip.render();
    CHECK(part.render({"--frames", "5"}).rendered == 1);
    CHECK(test::slurp(part.out() / "frame_0005.png") == test::slurp(clip.out() / "frame_0005.png"));
    part.render({"--frames", "2,5,6"});
    CHECK(test::slurp(part.out() / "frame_0002.png") == test::slurp(clip.out() / "frame_0002.png"));
  }
}

TEST_CASE("A damaged state is simulated again from the last good one") {
  const Clip clip(test::hanging_cloth());
  clip.render();
  const auto before = test::states_in(clip.out());
  REQUIRE(before.size() == 6);
  const auto damaged = clip.out() / std::next(before.begin(), 3)->first;
  std::string bytes = test::slurp(damaged);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(damaged, std::ios::binary) << bytes;
  std::filesystem::remove(clip.out() / "frame_0006.png");
  CHECK(clip.render() == Work{3, 1});
  CHECK(test::states_in(clip.out()) == before);
}

TEST_CASE("A new camera, light or picture draws again and does not simulate") {
  const Clip clip(test::hanging_cloth());
  clip.render();
  CHECK(clip.render({"--set", "camera.fov=50"}) == Work{0, 6});
  CHECK(clip.render({"--set", "render.samples=1"}) == Work{0, 6});
  CHECK(clip.render({"--set", "cloth.sheet.look.color=red"}) == Work{0, 6});
  CHECK(clip.render({"--set", "title=Another"}) == Work{0, 6});  // back to the first picture
  CHECK(clip.render({"--set", "title=A third"}) == Work{0, 0});
}

TEST_CASE("New physics simulates again, and the old simulation stays") {
  const Clip clip(test::hanging_cloth());
  clip.render();
  CHECK(clip.render({"--set", "cloth.sheet.density=300"}) == Work{6, 6});
  CHECK(clip.render({"--set", "time.substeps=3"}) == Work{6, 6});
  CHECK(clip.render() == Work{0, 6});
}

TEST_CASE("A longer clip goes on from the frames that are there") {
  const Clip clip(test::hanging_cloth());
  clip.render();
  CHECK(clip.render({"--set", "time.duration=0.3"}) == Work{3, 3});
  const test::RunResult shorter = test::run({"render", clip.scene.string(), "-o", clip.out().string()});
  CHECK(shorter.code == 0);
  CHECK(test::contains(shorter.err, "frame_0007.png"));  // said to be of a longer clip
  CHECK(test::pictures_in(clip.out()).size() == 9);
}

TEST_CASE("A longer clip that is framed as a whole is drawn again") {
  const Clip clip(test::small_scene());
  CHECK(clip.render() == Work{8, 8});
  CHECK(clip.render({"--set", "time.duration=0.3333"}) == Work{2, 10});
}

TEST_CASE("A mesh file with other content is simulated again, a touched one is not") {
  const Clip clip("[[cloth]]\nmesh = \"sheet.obj\"\n[time]\nduration = 0.1\n[render]\nsize = [32, 24]\nsamples = 1\n");
  clip.folder.write("sheet.obj", kTriangle);
  CHECK(clip.render() == Work{3, 3});
  clip.folder.write("sheet.obj", kTriangle);
  CHECK(clip.render() == Work{0, 0});
  clip.folder.write("sheet.obj", "v 0 1 0\n" + kTriangle);
  CHECK(clip.render().simulated == 3);
}

TEST_CASE("New colours or textures of a mesh file draw again and do not simulate") {
  const Clip clip("[[cloth]]\nmesh = \"sheet.obj\"\n[time]\nduration = 0.1\n[render]\nsize = [32, 24]\nsamples = 1\n");
  clip.folder.write("sheet.obj", "mtllib my paint.mtl\nusemtl paint\n" + kTriangle);
  CHECK(clip.render() == Work{3, 3});
  const auto plain = test::pictures_in(clip.out());
  clip.folder.write("my paint.mtl", "newmtl paint\nKd 1 0 0\n");
  clip.render();
  const auto red = test::pictures_in(clip.out());
  CHECK(red != plain);
  clip.folder.write("my paint.mtl", "newmtl paint\nKd 0 1 0\n");
  CHECK(clip.render() == Work{0, 3});
  CHECK(test::pictures_in(clip.out()) != red);
  clip.folder.write("my paint.mtl", "newmtl paint\nKd 0 1 0\nmap_Kd -s 1 1 1 skin.png\n");
  CHECK(clip.render() == Work{0, 3});  // the texture is not there yet
  std::filesystem::copy_file(clip.out() / "frame_0001.png", clip.folder / "skin.png");
  CHECK(clip.render() == Work{0, 3});
  CHECK(clip.render() == Work{0, 0});
}

TEST_CASE("The other half of a .node/.ele pair counts as physics") {
  const Clip clip("[[soft]]\nmesh = \"t.ele\"\n[time]\nduration = 0.1\n[render]\nsize = [32, 24]\nsamples = 1\n");
  clip.folder.write("t.ele", "1 4 0\n0 0 1 2 3\n");
  clip.folder.write("t.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
  CHECK(clip.render() == Work{3, 3});
  clip.folder.write("t.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 2\n");
  CHECK(clip.render() == Work{3, 3});
  CHECK(clip.render() == Work{0, 0});
}
