// softreel compare REF ACTUAL
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/arguments.h"
#include "app/compare_outputs.h"
#include "app/compare_scene.h"
#include "app/compare_update.h"
#include "app/exit_code.h"
#include "app/progress.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "render/png.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;
using assets::ErrorKind;
using assets::UserError;

bool exists(const std::string& path) {
  std::error_code unreadable;  // of a path that cannot even be asked about: not there, for us
  return fs::exists(path, unreadable);
}

bool is_folder(const std::string& path) {
  std::error_code unreadable;
  return fs::is_directory(path, unreadable);
}

/// The pictures that belong together, wherever they come from. `reference` may be missing, `actual` is there.
std::vector<FramePair> pairs_of(const CompareArguments& a, const std::optional<TemporaryFolder>& fresh) {
  if (fresh) return render_for_comparison(a, fresh->path());
  if (!exists(a.reference)) {
    if (!is_folder(a.actual)) {
      const std::string name = fs::path(a.reference).filename().string();
      return {{name, number_in(name), {}, a.actual}};
    }
    std::vector<FramePair> pairs;
    for (const std::string& name : pictures_in(a.actual))
      pairs.push_back({name, number_in(name), {}, fs::path(a.actual) / name});
    if (pairs.empty()) throw UserError(ErrorKind::kInput, a.actual, "there is no picture in this folder");
    return pairs;
  }
  if (is_folder(a.reference) != is_folder(a.actual))
    throw UserError(ErrorKind::kUsage,
                    "compare takes two pictures, two folders, or either and a scene; not a picture and a folder");
  if (is_folder(a.reference)) return pair_frames(a.reference, a.actual, a.update);
  const std::string name = fs::path(a.reference).filename().string();
  return {{name, number_in(name), a.reference, a.actual}};
}

void write_differences(const Comparison& c, const std::string& output, bool many) {
  if (output.empty()) return;
  if (many) assets::make_folders(output);
  for (std::size_t i = 0; i < c.pairs.size(); ++i) {
    const FramePair& pair = c.pairs[i];
    if (c.clip.frames[i].good || pair.reference.empty() || pair.actual.empty()) continue;
    const FrameRule rule = c.rules.rule_for(pair.name, pair.number);
    const fs::path file = many ? (fs::path(output) / pair.name).replace_extension(".png") : fs::path(output);
    render::write_png(file, picture_of_difference(pair, rule, ids_of(c.rules, rule, pair.name)));
  }
}

/// A failure that must not hide the answer: the folder of the references may be read-only.
void leave_what_has_no_reference(const Comparison& c, const std::string& reference, bool folder) {
  for (std::size_t i = 0; i < c.pairs.size(); ++i) {
    const FramePair& pair = c.pairs[i];
    if (c.clip.frames[i].state != FrameState::kExtra) continue;
    try {
      leave_beside(folder ? fs::path(reference) / pair.name : fs::path(reference), pair.actual);
    } catch (const UserError& error) {
      say(false, error.what());
    }
  }
}

void write_outputs(const Comparison& c, const CompareArguments& a, bool folder) {
  write_differences(c, a.output, folder);
  if (!a.json.empty()) assets::write_file_atomically(a.json, compare_json(c));
  if (!a.junit.empty()) assets::write_file_atomically(a.junit, compare_junit(c));
  if (!a.report.empty()) write_compare_page(a.report, c, a.report_pictures);
}

}  // namespace

int run_compare(const CompareArguments& a) {
  CompareRules rules(a);
  std::optional<TemporaryFolder> fresh;
  if (!exists(a.actual)) {
    fmt::print("{}: there is no such file or folder\n", a.actual);  // nothing there is not the same: an answer
    return kAnswerIsNo;
  }
  if (is_scene(a.actual)) fresh.emplace();
  const int threads = a.threads > 0 ? a.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const std::vector<FramePair> pairs = pairs_of(a, fresh);
  const bool folder = names_folder(a.reference, pairs.size());
  int last = 0;
  for (const FramePair& pair : pairs) last = std::max(last, pair.number);
  rules.resolve(last);

  Comparison c{a.reference, a.actual, a.command, pairs, rules, compare_clip(pairs, rules, threads, a.each, a.quiet)};
  fmt::print("{}", closing_lines(c));
  write_outputs(c, a, folder);
  if (a.update) {
    const int updated = update_references(c, a.reference);
    fmt::print("{} reference{} updated\n", updated, updated == 1 ? "" : "s");
    return kDone;
  }
  leave_what_has_no_reference(c, a.reference, folder);
  return c.clip.good() ? kDone : kAnswerIsNo;
}

}  // namespace softreel::app
