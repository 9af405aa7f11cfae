#include <doctest/doctest.h>

#include <cmath>

#include "assets/scene_canonical.h"
#include "assets/scene_table.h"
#include "test_scene_help.h"

namespace softreel::assets {

namespace {

template <class... Ts>
struct Overload : Ts... {
  using Ts::operator()...;
};

// Changes one value a little, whatever it is.
void change(const ValueRef& value) {
  std::visit(Overload{
                 [](double* v) { *v = std::nextafter(*v, 1e30); },
                 [](std::optional<double>* v) { *v = v->value_or(1) + 1; },
                 [](int* v) { *v += 1; },
                 [](bool* v) { *v = !*v; },
                 [](std::string* v) { *v += "x"; },
                 [](Vec3* v) { v->z() = std::nextafter(v->z(), 1e30); },
                 [](std::optional<Vec3>* v) { *v = Vec3(v->value_or(Vec3::Ones()) * 2); },
                 [](std::array<double, 2>* v) { (*v)[1] += 1; },
                 [](std::optional<std::array<double, 2>>* v) {
                   *v = std::array<double, 2>{-1, 2};
                 },
                 [](std::array<int, 2>* v) { (*v)[1] += 1; },
                 [](std::array<int, 3>* v) { (*v)[2] += 1; },
                 [](std::vector<int>* v) { v->push_back(7); },
                 [](std::vector<double>* v) { v->push_back(7); },
                 [](std::vector<Vec3>* v) { v->emplace_back(1, 2, 3); },
                 [](std::vector<std::array<int, 2>>* v) {
                   v->push_back({0, 1});
                 },
                 [](BodyName* v) { v->place += "x"; },
                 [](std::array<BodyName, 2>* v) { (*v)[1].place += "x"; },
                 [](std::optional<Accuracy>* v) {
                   *v = Accuracy{0.5, "mm"};
                 },
                 [](Color* v) { v->b += 0.01; },
                 [](std::optional<Color>* v) {
                   *v = Color{0.1, 0.2, 0.3};
                 },
                 [](std::optional<Box>* v) {
                   *v = Box{Vec3::Zero(), Vec3::Ones()};
                 },
                 [](const ChoiceRef& v) { v.set(v.value, (v.get(v.value) + 1) % static_cast<int>(v.names.size())); },
                 [](const FileRef& v) { *v.path += "x"; },
                 [](const NameRef& v) { *v.name += "x"; },
                 [](const PresetRef& v) { *v.name += "x"; },
                 [](const MethodRef& v) { *v.name += "x"; },
                 [](const ScaleRef& v) { v.value->x() *= 2; },
                 [](const AxesRef& v) { (*v.value)[1] = !(*v.value)[1]; },
                 [](const UnitRef& v) { *v.metres *= 2; },
                 [](const FormulaRef& v) { *v.text += "+1"; },
                 [](const AutoRef& v) { *v.value = *v.value == 3 ? 4 : 3; },
             },
             value);
}

// Walks to the key with a number and changes it.
class Changer : public KeyVisitor {
 public:
  explicit Changer(int number) : number_(number) {}

  std::string name;  // of the key that was changed; empty: there is no such number
  Role role = Role::kNeither;
  bool changeable = true;  // a choice of one cannot be changed

  void key(const Key& key, const ValueRef& value) override {
    if (count_++ != number_) return;
    name = prefix_ + key.name;
    role = key.role;
    const auto* choice = std::get_if<ChoiceRef>(&value);
    changeable = !choice || choice->names.size() > 1;
    change(value);
  }
  void section(const Section& section, const SectionRef& ref) override {
    const std::string outer = prefix_;
    prefix_ += std::string(section.name) + ".";
    ref.keys(*this);
    prefix_ = outer;
  }
  void list(const Section& section, const ListRef& ref) override {
    const std::string outer = prefix_;
    prefix_ += std::string(section.name) + ".";
    for (size_t i = 0; i < ref.size; ++i) ref.keys(i, *this);
    prefix_ = outer;
  }

 private:
  int number_;
  int count_ = 0;
  std::string prefix_;
};

// Every section and list is there.
const char* const kEverything = R"(
[[soft]]
block = {}
data = {}
pins = [{ box = [[0, 0, 0], [1, 2, 3]], motion = [{ t = 1 }] }]
[[cloth]]
grid = {}
data = {}
pins = [{ vertices = [0], motion = [{ t = 1 }] }]
[[field]]
grid = {}
fixed = [{ boundary = true }]
[[collider]]
motion = [{ t = 1 }]
[[springs]]
chain = {}
pins = [{ vertices = [0], motion = [{ t = 1 }] }]
[[load]]
body = "soft-1"
box = [[0, 0, 0], [1, 2, 3]]
force = [1, 0, 0]
[[attach]]
bodies = ["cloth-1", "soft-1"]
near = 1
[[contact.pair]]
between = ["soft-1", "cloth-1"]
[wind]
gusts = {}
[[light]]
)";

}  // namespace

TEST_CASE("a physics key changes the simulation only, a picture key the picture only, a name or limit neither") {
  const Scene scene = parse(kEverything);
  int physics = 0, picture = 0;
  for (int number = 0;; ++number) {
    Scene changed = scene;
    Changer changer(number);
    walk_scene(changer, changed);
    if (changer.name.empty()) break;
    if (!changer.changeable) continue;
    CAPTURE(changer.name);
    const bool new_physics = canonical_physics(changed) != canonical_physics(scene);
    CHECK(new_physics == (changer.role == Role::kPhysics));
    physics += new_physics;
    // The pictures of a clip that is framed as a whole follow its length.
    if (changer.name == "time.duration" || changer.name == "time.fps") continue;
    const bool new_picture = canonical_picture(changed) != canonical_picture(scene);
    CHECK(new_picture == (changer.role == Role::kPicture));
    picture += new_picture;
  }
  CHECK(physics > 80);
  CHECK(picture > 40);
}

TEST_CASE("one entry more or less changes the simulation or the picture") {
  const std::string one = "[[soft]]\nblock = {}\n";
  CHECK(canonical_physics(parse(one)) != canonical_physics(parse(one + one)));
  CHECK(canonical_physics(parse(one)) != canonical_physics(parse(one + "[[collider]]\n")));
  CHECK(canonical_physics(parse(one)) == canonical_physics(parse(one + "[[light]]\n[[light]]\n")));
  CHECK(canonical_picture(parse(one)) != canonical_picture(parse(one + "[[light]]\n[[light]]\n")));
}

TEST_CASE("a longer clip is no other simulation, and no other pictures where nothing is placed by the whole clip") {
  const std::string body = "[[soft]]\nblock = {}\n";
  const std::string placed = body +
                             "[camera]\nposition = [1, 2, 3]\ntarget = [0, 0, 0]\n[render]\nground = false\n"
                             "[[light]]\nposition = [1, 5, 1]\nradius = 1\n";
  const std::vector<std::string> longer = {"time.duration=10"};
  CHECK(canonical_physics(parse(body)) == canonical_physics(parse(body, longer)));
  CHECK(canonical_picture(parse(body)) != canonical_picture(parse(body, longer)));
  CHECK(canonical_picture(parse(placed)) == canonical_picture(parse(placed, longer)));
}

TEST_CASE("two ways to write the same scene are the same scene") {
  const Scene a = parse("title = 'a'\n[[soft]]\nname = 'x'\nblock = {}\nmaterial = 'rubber'\nscale = 2\n");
  const Scene b = parse(
      "[[soft]]\nscale = [2, 2, 2.0]\nblock = { cells = [8, 8, 8] }\ndensity = 930\n"
      "material = { poisson = 0.47, young = 2e6 }\n[time]\n");
  CHECK(canonical_physics(a) == canonical_physics(b));
  CHECK(canonical_picture(a) == canonical_picture(b));
}

TEST_CASE("a load on another body is another simulation, a body's new name is not, and names that change places are") {
  const std::string bodies = "[[soft]]\nname = 'a'\nblock = {}\n[[soft]]\nname = 'b'\nblock = {}\n";
  const auto load_on = [](const std::string& name) {
    return "[[load]]\nbody = '" + name + "'\nbox = [[0, 0, 0], [1, 1, 1]]\nforce = [1, 0, 0]\n";
  };
  const std::string here = canonical_physics(parse(bodies + load_on("a")));
  CHECK(here != canonical_physics(parse(bodies + load_on("b"))));
  const std::vector<std::string> renamed = {"soft.1.name=c", "load.1.body=c"};
  CHECK(here == canonical_physics(parse(bodies + load_on("a"), renamed)));
  const std::vector<std::string> swapped = {"soft.2.name=c", "soft.1.name=b", "soft.2.name=a"};
  CHECK(here != canonical_physics(parse(bodies + load_on("a"), swapped)));
}

TEST_CASE("numbers that differ in their last bit are written differently") {
  Scene a = parse("[[soft]]\nblock = {}\n");
  Scene b = a;
  b.soft[0].material.young = std::nextafter(a.soft[0].material.young, 1e9);
  CHECK(canonical_physics(a) != canonical_physics(b));
}

}  // namespace softreel::assets
