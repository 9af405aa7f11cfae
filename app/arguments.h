#pragma once
// What the command line says, one struct for each command.
#include <optional>
#include <string>
#include <vector>

namespace softreel::app {

struct CommonArguments {
  int threads = 0;  ///< 0: as many as the machine has
  bool quiet = false;
};

/// render and simulate.
struct ClipArguments : CommonArguments {
  std::string scene;
  std::string output;  ///< folder; empty: out/NAME of the scene
  std::string frames;
  std::vector<std::string> overrides;  ///< key=value
  std::string video;                   ///< render only
  std::string stats;                   ///< JSON file
  std::string export_format;           ///< simulate only: ply, vtu, pc2
  int jobs = 1;                        ///< render only: processes
  bool sheet = false;                  ///< render only: a contact sheet
  bool force = false;                  ///< simulate what is bound to fail, too
};

struct TurntableArguments : CommonArguments {
  std::string mesh;                    ///< or a scene
  std::string frame = "last";          ///< of a scene: that stands on the turntable
  std::vector<std::string> overrides;  ///< of a scene: key=value
  std::string output;                  ///< folder; empty: out/NAME-turntable
  std::string video;
  std::vector<int> size = {1280, 720};
  int count = 36;
  int samples = 16;
  double fps = 30;
  std::string up = "y";
  std::string color;
};

struct CompareArguments : CommonArguments {
  std::string reference, actual;       ///< pictures or folders; actual may be a scene, which is rendered then
  std::string tolerance;               ///< empty: that of the rules, or else driver
  std::string rules;                   ///< TOML file
  std::vector<std::string> masks;      ///< x,y,width,height [px]
  std::vector<int> mask_ids;           ///< body ids
  std::string ids;                     ///< picture or folder of body ids
  double flip_distance = 0;            ///< pixels per degree; 0: the paper's
  std::string frames;                  ///< of the scene; empty: those that the reference shows
  std::vector<std::string> overrides;  ///< of the scene
  std::string command;                 ///< as it was typed
  std::string output;                  ///< difference picture, or folder for them
  std::string json, junit, report;     ///< files; empty: not written
  int report_pictures = 24;            ///< frames whose pictures the report holds
  bool each = false;                   ///< a line for every frame
  bool update = false;                 ///< actual pictures become the references
};

struct CheckArguments : CommonArguments {
  std::string scene;
  std::vector<std::string> overrides;
  bool list = false;
};

struct TetrahedralizeArguments : CommonArguments {
  std::string mesh, output;
  double quality = 1.4, max_volume = 0, time_limit = 300, unit = 1;
  std::optional<double> size;
  std::string up = "y";
};

struct StudyArguments : CommonArguments {
  std::string scene;
  std::string output;  ///< folder; empty: out/NAME-study
  std::vector<std::string> overrides;
  std::vector<std::string> integrators, substeps, tolerances, linear, resolutions;  ///< to sweep; empty: the defaults
  std::vector<std::string> sweeps;                                                  ///< key=v1,v2
  std::string budget = "2m";
  int repeats = 3;
  std::string apply;     ///< target, such as 1%; empty: no copy of the scene
  std::string apply_to;  ///< file; empty: NAME-studied.toml beside the scene
  bool overwrite = false;
  std::string command;     ///< as it was typed
  bool stability = false;  ///< a map over two keys instead: which settings hold
  std::string x, y;        ///< of the map: key=range
  std::string cells = "20x20";
  bool render = false;   ///< pictures instead: error against the time they take
  bool regions = false;  ///< the integrators' stability regions instead; no scene
};

struct BenchArguments : CommonArguments {
  bool features = false;
  int repeats = 3;
};

// Each returns an exit code, or throws UserError, RenderError, Interrupted.
int run_render(const ClipArguments& arguments);
int run_simulate(const ClipArguments& arguments);
int run_turntable(const TurntableArguments& arguments);
int run_compare(const CompareArguments& arguments);
int run_study(const StudyArguments& arguments);
int run_bench(const BenchArguments& arguments);
int run_check(const CheckArguments& arguments);
int run_tetrahedralize(const TetrahedralizeArguments& arguments);

/// Program and libraries with their versions, for --version.
std::string version_text();

/// Our own version, as it stands in the pictures.
std::string version();

/// The exact words of the command line into one run. `argv` as in main.
int run_command_line(int argc, char** argv);

}  // namespace softreel::app
