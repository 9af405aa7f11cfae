#include "app/compare_update.h"

#include <fmt/format.h>

#include "assets/atomic_file.h"
#include "assets/error.h"

namespace softreel::app {

namespace fs = std::filesystem;

namespace {

void copy_whole(const fs::path& from, const fs::path& to) {
  assets::write_file_atomically(to, assets::read_file(from));
}

/// The place of the reference of a pair: known, or to be made.
fs::path place_of(const FramePair& pair, const std::string& reference, bool folder) {
  if (!pair.reference.empty()) return pair.reference;
  return folder ? fs::path(reference) / pair.name : fs::path(reference);
}

}  // namespace

int update_references(const Comparison& c, const std::string& reference) {
  int written = 0;
  const bool folder = names_folder(reference, c.pairs.size());
  for (std::size_t i = 0; i < c.pairs.size(); ++i) {
    const FrameResult& frame = c.clip.frames[i];
    if (frame.good || c.pairs[i].actual.empty()) continue;
    const fs::path place = place_of(c.pairs[i], reference, folder);
    if (place.has_parent_path()) assets::make_folders(place.parent_path());
    copy_whole(c.pairs[i].actual, place);
    std::error_code ignored;
    fs::remove(beside(place), ignored);
    ++written;
    fmt::print("updated: {}\n", place.string());
  }
  for (std::size_t i = 0; i < c.pairs.size(); ++i)
    if (c.clip.frames[i].state == FrameState::kMissing)
      fmt::print("kept: {} has no actual picture; remove it if the clip became shorter\n",
                 c.pairs[i].reference.string());
  return written;
}

fs::path beside(const fs::path& reference) {
  fs::path place = reference;
  return place.replace_extension(".actual" + reference.extension().string());
}

void leave_beside(const fs::path& reference, const fs::path& actual) {
  const fs::path place = beside(reference);
  if (place.has_parent_path()) assets::make_folders(place.parent_path());
  copy_whole(actual, place);
  fmt::print("{}: there is no such reference; the actual picture lies beside its place: {}\n", reference.string(),
             place.string());
}

}  // namespace softreel::app
