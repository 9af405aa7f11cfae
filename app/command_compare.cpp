// softreel compare REF ACTUAL
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/arguments.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "render/compare_images.h"
#include "render/image_io.h"
#include "render/png.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;
using assets::ErrorKind;
using assets::UserError;

bool is_picture(const fs::path& file) {
  static const std::set<std::string> kExtensions = {".png", ".jpg", ".jpeg", ".bmp", ".tga"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kExtensions.count(extension) > 0 && file.filename().string()[0] != '.';
}

std::vector<std::string> pictures_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file() && is_picture(it->path())) names.push_back(it->path().filename().string());
  if (error) throw UserError(ErrorKind::kInput, folder.string(), "cannot be read: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

struct Judged {
  bool same_bytes = false;
  render::ImageDifference difference;
  bool good = false;
};

Judged judge(const fs::path& reference, const fs::path& actual, bool strict, const fs::path& difference_file) {
  Judged j;
  if (assets::read_file(reference) == assets::read_file(actual)) {
    render::load_image(reference);  // the same bytes of something that is no picture are no success
    j.same_bytes = j.good = true;
    return j;
  }
  const render::Image a = render::load_image(reference), b = render::load_image(actual);
  j.difference = render::compare(a, b);
  j.good = j.difference.verdict == render::ImageVerdict::kSame ||
           (!strict && j.difference.verdict == render::ImageVerdict::kDriver);
  if (!j.good && !difference_file.empty()) render::write_png(difference_file, render::difference_image(a, b));
  return j;
}

std::string describe(const Judged& j) {
  if (j.same_bytes) return "same bytes";
  const render::ImageDifference& d = j.difference;
  if (!d.same_size) return "different sizes";
  if (d.verdict == render::ImageVerdict::kSame) return "same pixels";
  return fmt::format("{}: {} of {} pixels ({:.3g} %), at most {} levels (at {}, {}), mean {:.3g}",
                     render::verdict_name(d.verdict), d.differing_pixels, d.pixels, 100 * d.differing_fraction(),
                     d.max_levels, d.worst_x, d.worst_y, d.mean_levels);
}

/// Worse: another size, then more levels, then more pixels.
bool worse(const Judged& a, const Judged& b) {
  const auto key = [](const Judged& j) {
    return std::tuple(!j.good, !j.same_bytes && !j.difference.same_size, j.difference.max_levels,
                      j.difference.differing_pixels);
  };
  return key(a) > key(b);
}

int compare_folders(const CompareArguments& a) {
  const std::vector<std::string> references = pictures_in(a.reference), actuals = pictures_in(a.actual);
  if (references.empty()) throw UserError(ErrorKind::kInput, a.reference, "there is no picture in this folder");
  if (actuals.empty()) throw UserError(ErrorKind::kInput, a.actual, "there is no picture in this folder");
  if (!a.difference.empty()) assets::make_folders(a.difference);
  const bool strict = a.tolerance == "same";
  int bad = 0;
  std::size_t total = references.size();
  std::optional<Judged> worst;
  std::string worst_name;
  for (const std::string& name : references) {
    stop_if_interrupted();
    if (!std::binary_search(actuals.begin(), actuals.end(), name)) {
      fmt::print("{}: missing in {}\n", name, a.actual);
      ++bad;
      continue;
    }
    const Judged j =
        judge(fs::path(a.reference) / name, fs::path(a.actual) / name, strict,
              a.difference.empty() ? fs::path() : (fs::path(a.difference) / name).replace_extension(".png"));
    if (!j.good) {
      ++bad;
      fmt::print("{}: {}\n", name, describe(j));
    }
    if (!worst || worse(j, *worst)) {
      worst = j;
      worst_name = name;
    }
  }
  for (const std::string& name : actuals)
    if (!std::binary_search(references.begin(), references.end(), name)) {
      fmt::print("{}: has no reference in {}\n", name, a.reference);
      ++bad;
      ++total;
    }
  if (worst) fmt::print("worst: {}: {}\n", worst_name, describe(*worst));
  fmt::print("{} of {} frames differ\n", bad, total);
  return bad == 0 ? kDone : kAnswerIsNo;
}

}  // namespace

int run_compare(const CompareArguments& a) {
  std::error_code unreadable;  // of a path that cannot even be asked about: not there, for us
  for (const std::string& path : {a.reference, a.actual})
    if (!fs::exists(path, unreadable)) {
      // A missing reference is an answer (no), a missing actual picture too: nothing there is not the same.
      fmt::print("{}: there is no such file or folder\n", path);
      return kAnswerIsNo;
    }
  const bool folder = fs::is_directory(a.reference, unreadable);
  if (folder != fs::is_directory(a.actual, unreadable))
    throw UserError(ErrorKind::kUsage, "compare takes two pictures or two folders, not one of each");
  if (folder) return compare_folders(a);
  const Judged j = judge(a.reference, a.actual, a.tolerance == "same", a.difference);
  fmt::print("{}\n", describe(j));
  return j.good ? kDone : kAnswerIsNo;
}

}  // namespace softreel::app
