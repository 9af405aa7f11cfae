#include "app/compare_scene.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "app/frame_range.h"
#include "app/progress.h"
#include "assets/error.h"
#include "assets/scene_reader.h"
#include "render/png.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;
using assets::ErrorKind;
using assets::UserError;

int frame_of_picture(const fs::path& file) {
  if (const std::optional<render::PngText> text = render::read_png_text(file))
    if (const auto it = text->find("softreel:frame"); it != text->end())
      if (const int number = number_in("_" + it->second + ".png"); number > 0) return number;
  return number_in(file.filename().string());
}

/// For frames that were asked for: a reference may be missing.
std::vector<FramePair> references(const fs::path& reference, const std::vector<int>& frames) {
  std::vector<FramePair> pairs;
  std::error_code ignored;
  const bool picture = reference.has_extension() && !fs::is_directory(reference, ignored);
  if (picture && frames.size() != 1)
    throw UserError(ErrorKind::kUsage, "--frames: one picture is compared with one frame");
  for (const int frame : frames) {
    const fs::path file = picture ? reference : reference / frame_file_name(frame);
    pairs.push_back({file.filename().string(), frame, fs::exists(file, ignored) ? file : fs::path(), {}});
  }
  return pairs;
}

std::vector<FramePair> references(const fs::path& reference) {
  std::vector<FramePair> pairs;
  std::error_code ignored;
  if (!fs::exists(reference, ignored))
    throw UserError(ErrorKind::kInput, reference.string(),
                    "there is no such reference; --frames says which frames to render for a new one");
  if (fs::is_directory(reference, ignored)) {
    for (const std::string& name : pictures_in(reference))
      pairs.push_back({name, number_in(name), reference / name, {}});
    if (pairs.empty()) throw UserError(ErrorKind::kInput, reference.string(), "there is no picture in this folder");
  } else {
    pairs.push_back({reference.filename().string(), frame_of_picture(reference), reference, {}});
  }
  for (const FramePair& pair : pairs)
    if (pair.number < 1)
      throw UserError(ErrorKind::kInput, pair.reference.string(),
                      "it does not say which frame of the scene it is: neither inside nor by a number in its name");
  return pairs;
}

int frames_of(const CompareArguments& a) { return assets::read_scene(a.actual, a.overrides).time.frames(); }

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "softreel-compare-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw UserError(ErrorKind::kOutput, name, "cannot be made: " + std::generic_category().message(errno));
  path_ = name;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

bool is_scene(const std::string& file) {
  std::error_code ignored;
  return fs::path(file).extension() == ".toml" && !fs::is_directory(file, ignored);
}

std::vector<FramePair> render_for_comparison(const CompareArguments& a, const fs::path& folder) {
  std::vector<FramePair> pairs =
      a.frames.empty() ? references(a.reference) : references(a.reference, parse_frames(a.frames, frames_of(a)));
  std::set<int> numbers;
  for (const FramePair& pair : pairs) numbers.insert(pair.number);
  ClipArguments clip;
  clip.threads = a.threads;
  clip.quiet = true;
  clip.scene = a.actual;
  clip.output = folder.string();
  clip.overrides = a.overrides;
  clip.frames = fmt::format("{}", fmt::join(numbers, ","));
  say(a.quiet, fmt::format("rendering {} frame{} of {}", numbers.size(), numbers.size() == 1 ? "" : "s", a.actual));
  run_render(clip);
  for (FramePair& pair : pairs) pair.actual = folder / frame_file_name(pair.number);
  return pairs;
}

}  // namespace softreel::app
