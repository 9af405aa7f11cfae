// softreel study from outside: what it measures is what theory says, what it writes is whole, what it keeps goes on.
#include <csignal>
#include <fstream>
#include <sstream>

#include "sim/catalogue.h"
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;
using nlohmann::json;

namespace {

const std::string kOscillator = SOFTREEL_SOURCE_DIR "/assets/scenes/oscillator.toml";

/// Three soft links that swing out of the horizontal: smooth, nonlinear, without a closed form.
const std::string kPendulum = R"(title = "Links"
[time]
duration = 0.4                # twelve frames
substeps = 4
[[springs]]
name = "links"
chain = { from = [0, 0, 0], to = [0.6, 0, 0], links = 3 }
mass = 0.2
stiffness = 100
pins = [{ vertices = [0] }]
[camera]
position = [0, 0, 3]
target = [0, 0, 0]
[render]
size = [64, 48]
samples = 1
)";

json study(std::vector<std::string> arguments, const std::filesystem::path& output) {
  arguments.insert(arguments.begin(), std::string("study"));
  for (const char* more : {"--repeats", "1", "-o"}) arguments.emplace_back(more);
  arguments.push_back(output.string());
  const test::RunResult result = test::run(arguments);
  INFO(result.err);
  CHECK(result.code == 0);
  return json::parse(test::slurp(output / "study.json"));
}

const json& row(const json& study, const std::string& label) {
  for (const json& r : study.at("rows"))
    if (r.at("label") == label) return r;
  FAIL("no row " << label);
  return study;
}

double largest_order_error(const json& result) {
  double worst = 0;
  for (const sim::MethodInfo& info : sim::integrators())
    for (const auto& [method, order] : result.at("orders").items())
      if (method.substr(0, method.find(',')) == info.name) {
        INFO(method << ": order " << order);
        worst = std::max(worst, std::abs(order.get<double>() - info.order));
        CHECK(std::abs(order.get<double>() - info.order) < 0.15);
      }
  return worst;
}

}  // namespace

TEST_CASE("study finds the declared order of every integrator against the closed form of an oscillator") {
  test::TempFolder folder;
  std::string all;
  size_t count = 0;
  for (const sim::MethodInfo& info : sim::integrators())
    if (info.order > 0) all.append(count++ ? "," : "").append(info.name);
  const json result = study({kOscillator, "--integrators", all, "--tolerances", "1e-10", "--substeps", "8,16,32",
                             "--set", "time.duration=0.7"},
                            folder / "out");
  CHECK(result.at("orders").size() == count);
  MESSAGE("largest deviation of an order: " << largest_order_error(result));
  CHECK(result.at("reference").at("what") == "the closed form");
}

TEST_CASE("study finds the declared orders against a finer run, and stays above that run's own error") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const json result =
      study({scene.string(), "--integrators", "implicit-euler,newmark,implicit-midpoint,bdf2,verlet,rk4",
             "--tolerances", "1e-10", "--substeps", "32,64,128"},
            folder / "out");
  CHECK(result.at("orders").size() == 6);
  MESSAGE("largest deviation of an order: " << largest_order_error(result));
  const double floor = result.at("reference").at("floor_m");
  CHECK(floor > 0);
  for (const json& r : result.at("rows"))
    if (r.contains("errors")) CHECK(r.at("errors").at("worst_rms_m") > floor);
}

TEST_CASE("a run that blows up is a row with time, step and reason, and the rest of the study goes on") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const json result = study({scene.string(), "--set", "springs.links.stiffness=1e5", "--integrators",
                             "symplectic-euler,newmark", "--substeps", "1,64", "--tolerances", "1e-4"},
                            folder / "out");
  const json& failed = row(result, "symplectic-euler, 1 substep");
  CHECK_FALSE(failed.contains("errors"));
  CHECK(failed.at("failure").at("step") >= 1);
  CHECK(failed.at("failure").at("time") >= 0);
  CHECK_FALSE(failed.at("failure").at("why").get<std::string>().empty());
  CHECK(row(result, "symplectic-euler, 64 substeps").contains("errors"));
  const std::string csv = test::slurp(folder / "out/study.csv");
  const auto lines = std::count(csv.begin(), csv.end(), '\n');
  CHECK(lines == 1 + static_cast<long>(result.at("rows").size()));
  CHECK(test::contains(csv, "symplectic-euler"));
}

TEST_CASE("the report is one whole file with plots, table, machine and command, and nothing from elsewhere") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const json result = study({scene.string(), "--integrators", "verlet,newmark", "--substeps", "1,2,4"}, folder / "out");
  const std::string html = test::slurp(folder / "out/report.html");
  size_t rows = 0, plots = 0, pictures = 0;
  for (size_t at = 0; (at = html.find("<tr", at)) != std::string::npos; ++at) ++rows;
  for (size_t at = 0; (at = html.find("<svg", at)) != std::string::npos; ++at) ++plots;
  for (size_t at = 0; (at = html.find("data:image/png;base64,iVBOR", at)) != std::string::npos; ++at) ++pictures;
  CHECK(rows == 1 + result.at("rows").size());
  CHECK(plots == 2);
  CHECK(pictures == 2);
  for (const char* part : {"softreel study", "threads", "Eigen", "the scene now", "</html>"})
    CHECK(test::contains(html, part));
  for (const char* part : {"src=\"http", "href=\"http", "<link", "<?xml"}) CHECK_FALSE(test::contains(html, part));
  for (const char* name : {"error.svg", "error.png", "energy.svg", "energy.png"})
    CHECK(std::filesystem::file_size(folder / "out" / name) > 1000);
  test::check_only_whole_files(folder / "out");
}

TEST_CASE("three lines tell the fastest settings and what the scene has now") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const test::RunResult result = test::run({"study", scene.string(), "-o", (folder / "out").string(), "--quiet",
                                            "--integrators", "rk4", "--substeps", "8", "--repeats", "1"});
  CHECK(result.code == 0);
  CHECK(result.err.empty());
  CHECK(std::count(result.out.begin(), result.out.end(), '\n') == 3);
  CHECK(test::contains(result.out, "fastest under 1 %:  rk4, 8 substeps"));
  CHECK(test::contains(result.out, "fastest under 1 px: rk4, 8 substeps"));
  CHECK(test::contains(result.out, "the scene now:       as it is: implicit-euler, 4 substeps"));
  CHECK(test::contains(result.out, "rk4, 8 substeps is as good"));
}

TEST_CASE("a study without gnuplot says so and writes all the rest") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  test::RunOptions options;
  options.environment = {{"PATH", folder.path().string()}};
  const test::RunResult result =
      test::run({"study", scene.string(), "-o", (folder / "out").string(), "--integrators", "verlet"}, options);
  CHECK(result.code == 0);
  CHECK(test::contains(result.err, "gnuplot"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/error.svg"));
  CHECK(test::contains(test::slurp(folder / "out/report.html"), "</html>"));
}

TEST_CASE("an interrupted study keeps what is done and goes on from there") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const std::vector<std::string> command = {
      "study",      scene.string(), "-o", (folder / "out").string(), "--integrators", "verlet,rk4", "--substeps",
      "1,2,4,4096", "--repeats",    "1"};
  const auto rows = folder / "out/cache/rows";
  const auto kept = [&] {
    auto files = test::files_below(rows);
    std::erase_if(files, [](const auto& f) { return !f.first.ends_with(".json"); });
    return files;
  };
  test::Running running(command);
  REQUIRE(running.wait_for([&] { return std::filesystem::exists(rows) && kept().size() >= 2; }));
  running.send(SIGINT);
  const test::RunResult cut = running.wait();
  CHECK((cut.code == 130 || cut.code == 0));  // the rest may have been quicker
  test::check_only_whole_files(folder / "out");
  const auto before = kept();
  REQUIRE(test::run(command).code == 0);
  const auto after = kept();
  CHECK(after.size() == 9);  // four steps of two methods, and the scene as it is
  for (const auto& [name, bytes] : before) CHECK(after.at(name) == bytes);
}

TEST_CASE("what the budget has no time for is in the table as out of budget") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const json result = study({scene.string(), "--set", "time.duration=3", "--integrators", "newmark", "--tolerances",
                             "1e-10", "--substeps", "1,2,4000", "--budget", "2s"},
                            folder / "out");
  CHECK(row(result, "newmark, tolerance 1e-10, 1 substep").contains("errors"));
  const json& missing = row(result, "newmark, tolerance 1e-10, 4000 substeps");
  CHECK(missing.at("failure").at("kind") == "out of budget");
  CHECK(test::contains(test::slurp(folder / "out/study.csv"), "out of budget"));
}

TEST_CASE("--apply writes a copy with the recommended settings and leaves the scene alone") {
  test::TempFolder folder;
  const auto scene = folder.write("links.toml", kPendulum);
  const std::string out = (folder / "out").string();
  const std::vector<std::string> sweep = {"study",      scene.string(), "-o",  out,         "--integrators",
                                          "rk4,verlet", "--substeps",   "1,8", "--repeats", "1"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = sweep;
    all.insert(all.end(), more.begin(), more.end());
    return test::run(all);
  };
  CHECK(with({"--apply", "1%"}).code == 0);
  CHECK(test::slurp(scene) == kPendulum);
  const std::string copy = test::slurp(folder / "links-studied.toml");
  CHECK(test::contains(copy, "# twelve frames"));
  CHECK((test::contains(copy, "integrator = \"verlet\"") || test::contains(copy, "integrator = \"rk4\"")));
  CHECK(test::run({"check", (folder / "links-studied.toml").string()}).code == 0);
  CHECK(with({"--apply", "0.000000001mm"}).code == 4);
  CHECK(with({"--apply", "1%", "--apply-to", scene.string()}).code == 2);
  CHECK(test::slurp(scene) == kPendulum);
  CHECK(with({"--apply", "1%", "--apply-to", scene.string(), "--overwrite"}).code == 0);
  CHECK(test::slurp(scene) == copy);
}

TEST_CASE("studies that cannot be are refused with what is wrong") {
  test::TempFolder folder;
  const std::string scene = folder.write("links.toml", kPendulum).string();
  const std::string out = (folder / "out").string();
  const std::string field =
      folder.write("field.toml", "[[field]]\ngrid = {}\nfixed = [{ boundary = true }]\n").string();
  const std::string unheld =
      folder.write("unheld.toml", "[[cloth]]\ngrid = { cells = [2, 2] }\npins = [{ box = [[5, 5, 5], [6, 6, 6]] }]\n")
          .string();
  const std::string wrong =
      folder.write("wrong.toml", kPendulum + "[reference]\nbody = \"links\"\ny = \"1 + t\"\n").string();
  const auto refused = [&](const char* what, std::vector<std::string> arguments, int code,
                           std::vector<std::string> says) {
    arguments.insert(arguments.begin(), std::string("study"));
    arguments.emplace_back("-o");
    arguments.push_back(out);
    test::check_refused({what, arguments, code, std::move(says)});
  };
  refused("unknown key", {scene, "--sweep", "time.substep=1,2"}, 2, {"--sweep time.substep=1", "substeps"});
  refused("no values", {scene, "--sweep", "solver.omega"}, 2, {"--sweep solver.omega", "key=v1,v2"});
  refused("unknown integrator", {scene, "--integrators", "verlett"}, 2, {"verlett", "verlet"});
  refused("substeps of no number", {scene, "--substeps", "1,many"}, 2, {"many"});
  refused("a key of the problem", {scene, "--sweep", "springs.links.stiffness=1,2"}, 2, {"what is simulated"});
  refused("frames that differ", {scene, "--sweep", "time.fps=24,30"}, 2, {"time.fps"});
  refused("nothing to refine", {unheld, "--resolutions", "0"}, 2, {"--resolutions", "above 0"});
  refused("budget of no time", {scene, "--budget", "soon"}, 2, {"--budget", "60s"});
  refused("budget that is too small", {scene, "--budget", "1e-6s"}, 2, {"--budget", "too small"});
  refused("target without a unit", {scene, "--apply", "3"}, 2, {"--apply", "1%"});
  refused("only a field", {field}, 2, {"scalar fields"});
  refused("a scene that cannot run", {unheld}, 2, {"holds no vertex"});
  refused("a closed form that begins elsewhere", {wrong}, 2, {"reference", "at t = 0"});
  refused("a missing scene", {(folder / "none.toml").string()}, 3, {"none.toml"});
  refused("every run fails",
          {scene, "--set", "springs.links.stiffness=1e8", "--set", "time.integrator=verlet", "--set",
           "time.max_halvings=0", "--integrators", "verlet", "--substeps", "1"},
          4, {"none of the", "report.html"});
}
