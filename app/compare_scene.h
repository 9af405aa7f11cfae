#pragma once
// A reference against a scene: renders afresh what the reference shows.
#include <filesystem>
#include <string>

#include "app/arguments.h"
#include "app/frame_pairs.h"

namespace softreel::app {

/// A folder that is removed with its contents at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

bool is_scene(const std::string& file);

/// Renders `a.actual` into `folder`: the frames whose numbers the pictures of `a.reference` have (a single picture:
/// that in its text, or else in its name). Pairs of reference and new frame. A reference folder without pictures, or
/// none: throws UserError (kInput).
std::vector<FramePair> render_for_comparison(const CompareArguments& a, const std::filesystem::path& folder);

}  // namespace softreel::app
