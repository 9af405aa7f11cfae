#pragma once
// Which pictures of two folders belong together.
#include <filesystem>
#include <string>
#include <vector>

namespace softreel::app {

struct FramePair {
  std::string name;                         ///< file name, that of the reference
  int number = -1;                          ///< the last digits in the name; -1: none
  std::filesystem::path reference, actual;  ///< empty: missing on that side
};

/// The pictures directly in a folder, by the numbers in their names: frame_2 before frame_10. Throws UserError (kInput)
/// when it cannot be read.
std::vector<std::string> pictures_in(const std::filesystem::path& folder);

/// By name, in the order of pictures_in. Throws UserError (kInput) where a folder holds no picture (references may be
/// still to come: `make_references`, or left beside by an earlier comparison) and (kUsage) where both are the same
/// folder.
std::vector<FramePair> pair_frames(const std::filesystem::path& reference, const std::filesystem::path& actual,
                                   bool make_references);

/// Is, or will be, a folder of references for so many pictures.
bool names_folder(const std::filesystem::path& path, std::size_t pictures);

/// The last run of digits in a name; -1 for none or one beyond 9 digits.
int number_in(const std::string& name);

}  // namespace softreel::app
