#pragma once
// Whether output can be written, asked before the work instead of after it.
#include <filesystem>

namespace softreel::app {

/// Makes the folder if need be. Throws UserError (kOutput) when files cannot be made in it.
void check_output_folder(const std::filesystem::path& folder);

/// Makes the file's folder if need be; the file is not touched. Throws UserError (kOutput) when it could not be
/// written.
void check_output_file(const std::filesystem::path& file);

}  // namespace softreel::app
