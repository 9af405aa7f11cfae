#pragma once
// Cells of a stability map that are measured already, so that an interrupted map goes on.
#include <filesystem>
#include <optional>
#include <string>

#include "app/stability_map.h"

namespace softreel::app {

/// One small file a cell. Nothing is written before the first `write`.
class MapStore {
 public:
  explicit MapStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What a cell's outcome depends on. Throws UserError (kInput) for files that cannot be read.
  static std::string hash_of(const assets::Scene& scene);

  void write(const std::string& hash, const MapCell& cell) const;
  /// Nothing if there is none, or it is damaged.
  std::optional<MapCell> read(const std::string& hash) const;

 private:
  std::filesystem::path file(const std::string& hash) const { return folder_ / (hash + ".json"); }

  std::filesystem::path folder_;
};

}  // namespace softreel::app
