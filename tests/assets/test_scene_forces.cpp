// Loads, attachments, wind and bodies of points in scene files.
#include <doctest/doctest.h>

#include "test_scene_help.h"

namespace softreel::assets {

namespace {

const std::string kBlock = "[[soft]]\nname = 'block'\nblock = {}\n";
const std::string kLoad = "[[load]]\nbody = 'block'\nbox = [[0, 0, 0], [1, 1, 1]]\n";

struct Mistake {
  std::string text;
  int line, column;
  std::vector<std::string> says;
};

}  // namespace

TEST_CASE("loads, attachments, wind and points are read as they are written") {
  const Scene s = parse(kBlock + R"(
[[springs]]
name = "pendulum"
points = [[0, 0, 0], [1, 0, 0], [2, 0.5, 0]]
edges = [[0, 1], [1, 2]]
mass = [1, 2, 3.5]
stiffness = 500
rest_length = [1, 1.25]
damping = 0.1
radius = 0.05
[[springs]]
chain = { from = [0, 0, 0], to = [0, -2, 0], links = 4 }
[[load]]
name = "push"
body = "block"
box = [[0, 0, 0], [1, 1, 1]]
traction = [1, 2, 3]
from = 0.5
until = 2
ramp = 0.25
[[attach]]
bodies = ["pendulum", "block"]
near = 0.1
stiffness = 300
snap = true
[wind]
velocity = [5, 0, 1]
gusts = { amplitude = 0.5, seed = 3 }
)");
  REQUIRE(s.springs.size() == 2);
  CHECK(s.springs[0].points.size() == 3);
  CHECK(s.springs[0].points[2] == Vec3(2, 0.5, 0));
  CHECK(s.springs[0].edges[1] == std::array<int, 2>{1, 2});
  CHECK(s.springs[0].masses == std::vector<double>{1, 2, 3.5});
  CHECK(s.springs[0].stiffness == std::vector<double>{500});
  CHECK(s.springs[0].rest_length == std::vector<double>{1, 1.25});
  CHECK(s.springs[1].name == "springs-2");
  CHECK(s.springs[1].chain->links == 4);
  REQUIRE(s.loads.size() == 1);
  CHECK(s.loads[0].body.place == "soft.1");
  CHECK(*s.loads[0].traction == Vec3(1, 2, 3));
  CHECK(*s.loads[0].until == 2);
  REQUIRE(s.attachments.size() == 1);
  CHECK(s.attachments[0].name == "attach-1");
  CHECK(s.attachments[0].bodies[0].place == "springs.1");
  CHECK(s.attachments[0].bodies[1].place == "soft.1");
  CHECK(s.attachments[0].snap);
  REQUIRE(s.wind);
  CHECK(s.wind->velocity == Vec3(5, 0, 1));
  CHECK(s.wind->gusts->seed == 3);
}

TEST_CASE("a scene that says nothing of them has none, air may be still") {
  const Scene none = parse(kBlock);
  CHECK(none.springs.empty());
  CHECK(none.loads.empty());
  CHECK(none.attachments.empty());
  CHECK_FALSE(none.wind);
  const Scene still = parse(kBlock + "[wind]\n");
  REQUIRE(still.wind);
  CHECK(still.wind->velocity == Vec3::Zero());
  CHECK_FALSE(still.wind->gusts);
}

TEST_CASE("a reference names a body of the scene and gives its displacement in formulas") {
  const Scene s = parse(kBlock + "[reference]\nbody = \"block\"\ny = \"x*sin(2*t)\"\nz = 0.5\n");
  REQUIRE(s.reference);
  CHECK(s.reference->body.place == "soft.1");
  CHECK(s.reference->x == "0");
  CHECK(s.reference->y == "x*sin(2*t)");
  CHECK_FALSE(parse(kBlock).reference);
  for (const auto& [text, says] : {std::pair{"[reference]\ny = 1\n", "names no body"},
                                   std::pair{"[reference]\nbody = \"none\"\n", "there is no body \"none\""},
                                   std::pair{"[reference]\nbody = \"block\"\ny = \"sin(\"\n", "formula"}}) {
    CAPTURE(text);
    try {
      parse(kBlock + text);
      FAIL_CHECK("it was read");
    } catch (const UserError& e) {
      CHECK(std::string(e.what()).find(says) != std::string::npos);
    }
  }
}

TEST_CASE("overrides reach loads by name, and wind that the file does not mention") {
  const std::vector<std::string> overrides = {"load.push.force=[0, 5, 0]", "wind.velocity=[1, 2, 3]"};
  const Scene s = parse(kBlock + kLoad + "name = 'push'\nforce = [1, 0, 0]\n", overrides);
  CHECK(*s.loads[0].force == Vec3(0, 5, 0));
  CHECK(s.wind->velocity == Vec3(1, 2, 3));
}

TEST_CASE("mistakes in loads, attachments and points are reported where they stand") {
  const std::string points = "[[springs]]\npoints = [[0, 0, 0], [1, 0, 0], [1, 0, 0]]\n";
  const std::vector<Mistake> mistakes = {
      {kBlock + "[[load]]\nbody = 'blok'\nbox = [[0, 0, 0], [1, 1, 1]]\nforce = [0, 1, 0]\n",
       5,
       8,
       {"load.1.body", "no body \"blok\"", "did you mean \"block\"?"}},
      {kBlock + "[[load]]\nbox = [[0, 0, 0], [1, 1, 1]]\nforce = [0, 1, 0]\n", 4, 0, {"acts on nothing"}},
      {kBlock + "[[load]]\nbody = 'block'\nforce = [0, 1, 0]\n", 4, 0, {"acts nowhere"}},
      {kBlock + kLoad, 4, 0, {"has no size"}},
      {kBlock + kLoad + "force = [0, 1, 0]\ntraction = [0, 1, 0]\n", 8, 12, {"both force and traction"}},
      {kBlock + kLoad + "force = [0, 1, 0]\nfrom = 2\nuntil = 1\n", 9, 9, {"more than from = 2"}},
      {"[[springs]]\nname = 'p'\nchain = {}\n[[load]]\nbody = 'p'\nbox = [[0, 0, 0], [1, 1, 1]]\ntraction = [0, 1, 0]",
       7,
       12,
       {"has none"}},
      {kBlock + "[[attach]]\nbodies = ['block', 'bloc']\nnear = 1\n", 5, 20, {"attach.1.bodies.2", "\"block\""}},
      {kBlock + "[[attach]]\nbodies = ['block', 'block']\nnear = 1\n", 5, 10, {"to itself"}},
      {kBlock + "[[attach]]\nbodies = ['block']\nnear = 1\n", 5, 10, {"names of two bodies"}},
      {kBlock + "[[cloth]]\nname = 'c'\ngrid = {}\n[[attach]]\nbodies = ['block', 'c']\n", 7, 0, {"near = DISTANCE"}},
      {"[[springs]]\n", 1, 0, {"has no points"}},
      {"[[springs]]\nchain = {}\npoints = [[0, 0, 0]]\n", 2, 9, {"both points and chain"}},
      {"[[springs]]\npoints = []\n", 2, 10, {"no points are listed"}},
      {points + "edges = [[0, 1], [1, 3]]\n", 3, 18, {"names point 3; there are points 0 to 2"}},
      {points + "edges = [[0, 1], [1, 0]]\n", 3, 18, {"same points as edge 1"}},
      {points + "edges = [[1, 1]]\n", 3, 10, {"joins point 1 with itself"}},
      {points + "edges = [[1, 2]]\n", 3, 10, {"points 1 and 2 are at the same place", "no direction"}},
      {points + "mass = [1, 2]\n", 3, 8, {"found 2 numbers, expected one, or 3: one for each point"}},
      {points + "mass = [1, 0, 1]\n", 3, 12, {"springs.1.mass: found 0", "above 0"}},
      {points + "mass = []\n", 3, 8, {"springs.1.mass: found"}},
      {"[[springs]]\nchain = { from = [1, 2, 3], to = [1, 2, 3] }\n", 2, 34, {"no length"}},
      {kBlock + kLoad + "name = 'x'\nforce = [1, 0, 0]\n" + kLoad + "name = 'x'\nforce = [1, 0, 0]\n",
       12,
       8,
       {"already that of load.1"}},
  };
  for (const Mistake& m : mistakes) {
    CAPTURE(m.text);
    const std::vector<Problem> problems = problems_of(m.text);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].line == m.line);
    if (m.column > 0) CHECK(problems[0].column == m.column);
    for (const std::string& part : m.says) CHECK_MESSAGE(contains(problems[0].message, part), problems[0].message);
  }
}

TEST_CASE("points at one place may be joined by an edge that wants no length") {
  const std::string text = "[[springs]]\npoints = [[1, 0, 0], [1, 0, 0]]\nedges = [[0, 1]]\nrest_length = 0\n";
  CHECK(problems_of(text).empty());
}

}  // namespace softreel::assets
