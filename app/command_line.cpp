#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>

#include "app/arguments.h"
#include "app/exit_code.h"
#include "assets/error.h"
#include "assets/scene_nearest.h"

namespace softreel::app {
namespace {

constexpr const char* kExamples = R"(Examples:
  softreel render hello.toml --video hello.mp4
  softreel render hello.toml --frames 1-48 --set render.samples=4
  softreel simulate hello.toml --export vtu
  softreel turntable spot.obj --count 36 --video spin.mp4
  softreel compare reference/ out/hello/
  softreel study hello.toml --budget 5m --apply 1px
  softreel check hello.toml
  softreel bench --features
  softreel tetrahedralize spot.obj -o spot.msh

Exit codes: 0 done; 1 the answer is no; 2 wrong usage or scene; 3 an input file or a needed program is missing or
unusable; 4 the simulation failed; 5 output could not be written; 6 a bug of ours; 130 interrupted.)";

void add_common(CLI::App& command, CommonArguments& a) {
  command.add_option("--threads", a.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
  command.add_flag("-q,--quiet", a.quiet, "no progress, no remarks");
}

void add_clip(CLI::App& command, ClipArguments& a) {
  command.add_option("scene", a.scene, "scene file (TOML)")->required();
  command.add_option("-o,--output", a.output, "folder for frames and cache (default: out/NAME of the scene)");
  command.add_option("--frames", a.frames, "frames, such as 1-48 or 1,5,10-20x2 (default: all)");
  command.add_option("--set", a.overrides, "override a key of the scene: soft.spot.material.young=1e5")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--stats", a.stats, "write counts, seconds and energies to this JSON file");
  command.add_flag("--force", a.force, "simulate even where the step is so long that it is bound to fail");
  add_common(command, a);
}

void add_study(CLI::App& command, StudyArguments& a) {
  command.add_option("scene", a.scene, "scene file (TOML)");
  command.add_option("-o,--output", a.output, "folder for report and cache (default: out/NAME-study)");
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* help) {
    command.add_option(name, values, help)->delimiter(',')->allow_extra_args(false)->type_name("A,B,...");
  };
  list("--integrators", a.integrators, "time.integrator to compare (default: what suits the scene; so below)");
  list("--substeps", a.substeps, "time.substeps: 1,2,4,8");
  list("--tolerances", a.tolerances, "solver.tolerance: 1e-2,1e-4");
  list("--linear", a.linear, "solver.linear: cg,cholesky (default: the scene's)");
  list("--resolutions", a.resolutions, "factors on the cells of grids, blocks and chains: 0.5,1,2 (default: 1)");
  command.add_option("--sweep", a.sweeps, "any other key of how it is computed: solver.omega=1,1.5")
      ->type_name("KEY=A,B,...")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--set", a.overrides, "override a key of the scene for all runs")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--budget", a.budget, "time for all of it: 60s, 5m; cheap runs come first")->capture_default_str();
  command.add_option("--repeats", a.repeats, "runs whose median time counts; long runs are not repeated")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI::Option* apply = command.add_option(
      "--apply", a.apply, "write a copy of the scene with the fastest settings within this error: 1%, 1px, 1mm");
  command.add_option("--apply-to", a.apply_to, "file of that copy (default: NAME-studied.toml)")->needs(apply);
  command.add_flag("--overwrite", a.overwrite, "let --apply-to be the scene itself")->needs(apply);
  CLI::Option* map = command.add_flag("--stability", a.stability, "instead: which settings hold, over two keys");
  command.add_option("--x", a.x, "of the map: time.substeps=1..64 (in equal ratios), time.integrator=verlet,rk4")
      ->needs(map)
      ->type_name("KEY=RANGE");
  command.add_option("--y", a.y, "of the map: soft.block.material.young=1e2..1e9")->needs(map)->type_name("KEY=RANGE");
  command.add_option("--cells", a.cells, "of the map")->needs(map)->capture_default_str();
  command.add_flag("--render", a.render, "instead: error of pictures with 1 to 256 samples, and their time");
  command.add_flag("--regions", a.regions, "instead: stability regions of all integrators; needs no scene");
  add_common(command, a);
}

void add_compare(CLI::App& command, CompareArguments& a) {
  command.add_option("reference", a.reference, "picture or folder that is right")->required();
  command.add_option("actual", a.actual, "picture or folder to judge, or a scene to render for it")->required();
  command.add_option("--tolerance", a.tolerance,
                     "bytes, pixels (same), driver (default), perceptual; limits: levels=5,pixels=1%,cluster=30%, "
                     "flip=0.02,visible=1%");
  command.add_option("--rules", a.rules, "TOML file with tolerance, masks and exceptions for some frames");
  command.add_option("--mask", a.masks, "a rectangle that does not count: x,y,width,height [px]; may be repeated")
      ->type_name("X,Y,W,H")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option(
      "--ids", a.ids,
      "picture of body ids (grey, 8 or 16 bits), or folder with one for each frame (id_0001.png, or its name)");
  command.add_option("--mask-id", a.mask_ids, "a body that does not count, by its id; may be repeated")
      ->take_all()
      ->allow_extra_args(false)
      ->check(CLI::Range(0, 65535));
  command.add_option("--pixels-per-degree", a.flip_distance, "how far one looks from, for FLIP (default: 67)")
      ->check(CLI::Range(1.0, 1000.0));
  command.add_option("--frames", a.frames, "of a scene (default: those that the reference shows)");
  command.add_option("--set", a.overrides, "override a key of the scene")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("-o,--output", a.output,
                     "write pictures of the differences there (file for one, folder for many)");
  command.add_option("--json", a.json, "write every figure to this file");
  command.add_option("--junit", a.junit, "write JUnit XML to this file");
  command.add_option("--report", a.report, "write one HTML page to this file");
  command.add_option("--report-pictures", a.report_pictures, "frames whose pictures the page holds, the worst first")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command.add_flag("--each", a.each, "print a line for every frame, good ones too");
  command.add_flag("--update", a.update, "say what changes, then make the actual pictures the references");
  add_common(command, a);
}

/// Before CLI11 says that a command is missing, which is not what is wrong with a misspelled one.
void refuse_unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (word.starts_with('-') || std::find(names.begin(), names.end(), word) != names.end()) return;
  const std::string nearest = assets::nearest_name(word, names);
  throw assets::UserError(
      assets::ErrorKind::kUsage,
      fmt::format("there is no command \"{}\"{}; the commands are: {}", word,
                  nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest), fmt::join(names, ", ")));
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("One scene file to a rendered clip of cloth and soft bodies, without a display.", "softreel");
  app.footer(kExamples);
  app.require_subcommand(1);
  app.set_version_flag(
      "--version", [] { return version_text(); }, "print the versions of softreel and its libraries");
  std::function<int()> run;

  ClipArguments render;
  auto* command = app.add_subcommand("render", "simulate and render a scene; what is up to date is not done again");
  add_clip(*command, render);
  command->add_option("--video", render.video, "also write a video (.mp4, .mov, .mkv) through ffmpeg");
  command->add_option("--jobs", render.jobs, "render in so many processes with one thread each; the same bits")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--sheet", render.sheet, "also write sheet.png: evenly spaced frames and their times");
  command->callback([&] { run = [&] { return run_render(render); }; });

  ClipArguments simulate;
  command = app.add_subcommand("simulate", "only fill the cache of a scene");
  add_clip(*command, simulate);
  command
      ->add_option("--export", simulate.export_format, "write the moving meshes for Blender (ply, pc2), ParaView (vtu)")
      ->check(CLI::IsMember({"ply", "vtu", "pc2"}));
  command->callback([&] { run = [&] { return run_simulate(simulate); }; });

  TurntableArguments turntable;
  command = app.add_subcommand("turntable", "pictures of a mesh or of a scene's frame, once around");
  command->add_option("mesh", turntable.mesh, "surface or tetrahedral mesh, or a scene (.toml)")->required();
  command->add_option("--frame", turntable.frame, "of a scene: frame that is shown (a number, or last)")
      ->capture_default_str();
  command->add_option("--set", turntable.overrides, "override a key of the scene")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("-o,--output", turntable.output, "folder for the frames (default: out/NAME-turntable)");
  command->add_option("--count", turntable.count, "pictures in one turn")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--size", turntable.size, "width and height [px]")->expected(2)->check(CLI::Range(1, 8192));
  command->add_option("--samples", turntable.samples, "passes averaged into one picture")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  command->add_option("--fps", turntable.fps, "pictures per second of the video")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command->add_option("--up", turntable.up, "axis of the file that points up")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->capture_default_str();
  command->add_option("--color", turntable.color, "instead of the file's colours: \"#rrggbb\" or a name");
  command->add_option("--video", turntable.video, "also write a video (.mp4, .mov, .mkv) through ffmpeg");
  add_common(*command, turntable);
  command->callback([&] { run = [&] { return run_turntable(turntable); }; });

  StudyArguments study;
  for (int i = 0; i < argc; ++i) study.command += (i ? " " : "") + std::string(argv[i]);
  add_study(*app.add_subcommand("study", "error against run time over a sweep of settings: table, plots, report"),
            study);
  app.get_subcommand("study")->callback([&] { run = [&] { return run_study(study); }; });

  CompareArguments compare;
  compare.command = study.command;
  add_compare(*app.add_subcommand("compare", "pictures or clips against references; exit code 1 if they differ"),
              compare);
  app.get_subcommand("compare")->callback([&] { run = [&] { return run_compare(compare); }; });

  BenchArguments bench;
  command = app.add_subcommand("bench", "what features cost where they are used, on this machine");
  command->add_flag("--features", bench.features, "a table of them, each against the same scene without it")
      ->required();
  command->add_option("--repeats", bench.repeats, "runs of each scene, in turns, whose median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_common(*command, bench);
  command->callback([&] { run = [&] { return run_bench(bench); }; });

  CheckArguments check;
  command = app.add_subcommand("check", "validate a scene; print what it needs and what is left out, and why");
  command->add_option("scene", check.scene, "scene file (TOML)");
  command->add_option("--set", check.overrides, "override a key of the scene")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--list", check.list, "print every key and name that a scene can choose");
  add_common(*command, check);
  command->callback([&] { run = [&] { return run_check(check); }; });

  TetrahedralizeArguments tets;
  command = app.add_subcommand("tetrahedralize", "fill a closed surface with tetrahedra");
  command->add_option("mesh", tets.mesh, "closed surface, or a tetrahedral mesh to convert")->required();
  command->add_option("-o,--output", tets.output, "file to write: .msh, .mesh, .vtu, .node")->required();
  command->add_option("--quality", tets.quality, "largest ratio of circumradius to shortest edge")
      ->check(CLI::Range(1.1, 100.0))
      ->capture_default_str();
  command->add_option("--max-volume", tets.max_volume, "largest tetrahedron [m^3]")->check(CLI::PositiveNumber);
  command->add_option("--time-limit", tets.time_limit, "[s]")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--unit", tets.unit, "metres per unit of the file")->check(CLI::PositiveNumber);
  command->add_option("--size", tets.size, "scale the longest side to this [m]")->check(CLI::PositiveNumber);
  command->add_option("--up", tets.up, "axis of the file that points up")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->capture_default_str();
  add_common(*command, tets);
  command->callback([&] { run = [&] { return run_tetrahedralize(tets); }; });

  if (argc > 1) refuse_unknown_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    app.exit(e);
    return kWrongUsage;
  }
  return run();
}

}  // namespace softreel::app
