// time.accuracy from the scene file to the figures of a run.
#include <signal.h>

#include <cmath>

#include "app/clip_cache.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

std::string pendulum(const std::string& time) {
  return "[time]\nfps = 24\nduration = 1\n" + time +
         "[[springs]]\nname = \"chain\"\nchain = { from = [0, 0, 0], to = [0.8, 0, 0], links = 3 }\nmass = 0.1\n"
         "stiffness = 300\npins = [{ vertices = [0] }]\n"
         "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nfov = 40\n[render]\nsize = [64, 48]\n";
}

nlohmann::json simulate(const std::string& text, const test::TempFolder& folder, const std::string& name) {
  const std::string scene = folder.write(name + ".toml", text).string();
  return test::stats_of({"simulate", scene, "-o", (folder / name).string()}, folder);
}

app::ClipCache cache_of(const test::TempFolder& folder, const std::string& name, const nlohmann::json& stats) {
  return app::ClipCache(folder / name / "cache", stats.at("sim_hash").get<std::string>());
}

/// Largest over the frames of the RMS over the vertices [m].
double apart(const app::ClipCache& a, const app::ClipCache& b, int frames) {
  double largest = 0;
  for (int f = 1; f <= frames; ++f) {
    const Eigen::VectorXd d = a.read(f)->state.x - b.read(f)->state.x;
    largest = std::max(largest, d.norm() / std::sqrt(double(d.size()) / 3));
  }
  return largest;
}

test::RunResult check(const std::string& text, const std::vector<std::string>& more) {
  test::TempFolder folder;
  std::vector<std::string> arguments = {"check", folder.write("scene.toml", text).string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run(arguments);
}

}  // namespace

TEST_CASE("accuracy in millimetres, pixels and percent keeps the error of every frame below it") {
  test::TempFolder folder;
  const auto fine = simulate(pendulum("integrator = \"rk4\"\nsubsteps = 200\n"), folder, "fine");
  const app::ClipCache exact = cache_of(folder, "fine", fine);
  const double metres_per_pixel = 2 * 5 * std::tan(20 * M_PI / 180) / 48;
  struct Case {
    const char *name, *accuracy, *integrator;
    double metres;
  };
  for (const Case& c : {Case{"mm", "1 mm", "newmark", 1e-3}, Case{"px", "0.01 px", "verlet", 0.01 * metres_per_pixel},
                        Case{"percent", "0.05 %", "rk4", 0.0005 * 0.8}}) {
    const auto stats =
        simulate(pendulum(std::string("integrator = \"") + c.integrator + "\"\naccuracy = \"" + c.accuracy + "\"\n"),
                 folder, c.name);
    INFO(c.name);
    const auto& a = stats.at("accuracy");
    const double unit = c.metres / a.at("asked").get<double>();  // [m]
    const double error = apart(cache_of(folder, c.name, stats), exact, 24);
    CHECK(a.at("met") == true);
    CHECK(error <= c.metres);
    CHECK(a.at("estimate").get<double>() <= a.at("asked").get<double>());
    CHECK(a.at("estimate").get<double>() * unit >= 0.8 * error);
    CHECK(a.at("per_frame").size() == 24);
    CHECK(a.at("steps") == stats.at("steps"));
    CHECK(a.at("coarse_steps").get<long>() > 0);
  }
}

TEST_CASE("A simulation with accuracy that is interrupted between and within its runs goes on to the same bits") {
  test::TempFolder folder;
  const std::string text = pendulum("integrator = \"implicit-euler\"\naccuracy = \"0.5 mm\"\n");
  simulate(text, folder, "whole");
  const auto reference = test::states_in(folder / "whole");
  REQUIRE(reference.size() == 24);
  const std::string scene = folder.write("part.toml", text).string();
  const std::vector<std::string> arguments = {"simulate", scene, "-o", (folder / "part").string()};
  for (size_t states : {5, 30, 70}) {  // of all runs together
    test::Running program(arguments);
    if (!program.wait_for([&] { return test::states_in(folder / "part").size() >= states; })) break;
    program.send(SIGINT);
    program.wait();
  }
  CHECK(test::run(arguments).code == 0);
  CHECK(test::states_in(folder / "part") == reference);
}

TEST_CASE("The closing lines name the estimate, and nothing is said about accuracy where none is asked for") {
  test::TempFolder folder;
  const auto lines = [&](const std::string& time) {
    const std::string scene = folder.write("scene.toml", pendulum(time)).string();
    return test::run({"simulate", scene, "-o", (folder / "out").string()}).err;
  };
  const std::string with = lines("accuracy = \"2 mm\"\nintegrator = \"bdf2\"\n");
  CHECK(test::contains(with, "error in time: "));
  CHECK(test::contains(with, "asked for were 2 mm"));
  CHECK_FALSE(test::contains(lines("integrator = \"bdf2\"\n"), "asked for"));
}

TEST_CASE("accuracy of a field is a part of the range of its values") {
  test::TempFolder folder;
  const auto heat = [](const std::string& time) {
    return "[time]\nfps = 20\nduration = 0.5\n" + time +
           "[[field]]\nname = \"plate\"\nequation = \"heat\"\ndiffusivity = 0.05\n"
           "grid = { size = [1, 1], cells = [8, 8] }\ninitial = \"cos(pi*x)*cos(pi*z)\"\nfixed = [{ boundary = true "
           "}]\n";
  };
  const auto stats = simulate(heat("integrator = \"implicit-euler\"\naccuracy = \"0.2 %\"\n"), folder, "adaptive");
  const auto fine = simulate(heat("integrator = \"rk4\"\nsubsteps = 100\n"), folder, "fine");
  const app::ClipCache a = cache_of(folder, "adaptive", stats), b = cache_of(folder, "fine", fine);
  double error = 0;
  for (int f = 1; f <= 10; ++f) {
    const Eigen::VectorXd d = a.read(f)->fields[0].value - b.read(f)->fields[0].value;
    error = std::max(error, d.norm() / std::sqrt(double(d.size())));
  }
  CHECK(error <= 0.002);  // the values go from 0 to 1
  CHECK(error >= 0.0002);
  CHECK(stats.at("accuracy").at("met") == true);
  const auto stable = simulate(heat("integrator = \"forward-euler\"\naccuracy = \"5 %\"\n"), folder, "explicit");
  CHECK(stable.at("accuracy").at("met") == true);
}

TEST_CASE("A scene with impacts runs with accuracy, too, and says when it cannot promise it") {
  test::TempFolder folder;
  const std::string text =
      "[time]\nfps = 24\nduration = 0.5\nintegrator = \"implicit-euler\"\naccuracy = \"5 %\"\n"
      "[[springs]]\nname = \"pair\"\nchain = { from = [0, 0.3, 0], to = [0.2, 0.4, 0], links = 1 }\nmass = 0.1\n"
      "[[collider]]\nshape = \"plane\"\n[contact]\ndistance = 0.02\n";
  const auto stats = simulate(text, folder, "drop");
  CHECK(stats.at("accuracy").contains("met"));
  CHECK(test::states_in(folder / "drop").size() == 12);
}

TEST_CASE("What accuracy cannot mean is refused, with what it can") {
  const auto refused = [](const std::string& time, const std::string& message) {
    const test::RunResult result = check(pendulum(time), {});
    INFO(result.err);
    CHECK(result.code == 2);
    CHECK(test::contains(result.err, message));
  };
  refused("accuracy = 1\n", "say what it is measured in, \"1 mm\"");
  refused("accuracy = \"1 potato\"\n", "such as \"1 mm\", \"0.5 px\" or \"0.1 %\"");
  refused("accuracy = \"0 mm\"\n", "a number above 0");
  refused("accuracy = \"mm\"\n", "a number above 0");
  refused("accuracy = \"1 mn\"\n", "did you mean");
  refused("accuracy = \"1 mm\"\nintegrator = \"static\"\n", "is an error in time");
  const test::RunResult field = check("[time]\naccuracy = \"1 mm\"\n[[field]]\ngrid = { size = [1, 1] }\n", {});
  CHECK(field.code == 2);
  CHECK(test::contains(field.err, "the values of a field are no lengths"));
  const test::RunResult good = check(pendulum("accuracy = \"1 mm\"\n"), {});
  CHECK(good.code == 0);
  CHECK(test::contains(good.out, "steps as an error of 1 mm needs them"));
}
