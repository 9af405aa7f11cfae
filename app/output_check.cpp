#include "app/output_check.h"

#include "assets/atomic_file.h"

namespace softreel::app {

void check_output_folder(const std::filesystem::path& folder) {
  assets::make_folders(folder);
  const assets::AtomicFile probe(folder / "probe");  // goes away again
}

void check_output_file(const std::filesystem::path& file) {
  if (file.has_parent_path()) assets::make_folders(file.parent_path());
  const assets::AtomicFile probe(file);
}

}  // namespace softreel::app
