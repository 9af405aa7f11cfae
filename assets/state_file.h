#pragma once
// The cache of a simulation: one frame's state per file, from which the simulation goes on to the same bits.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace softreel::assets {

/// Everything a simulation needs to go on: "x" [m], "v" [m/s], "history/0", ... Names are free; all bits are kept (NaN
/// and -0 too).
struct StateRecord {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, double> scalars;
};

/// Writes under a temporary name and renames. `hash` says what the state belongs to (the sim_hash and frame number,
/// say). `sync`: wait for the disk. Throws UserError(kOutput).
void write_state(const std::filesystem::path& file, const std::string& hash, const StateRecord& record,
                 bool sync = false);

/// Nothing when the file is missing, truncated, damaged (checksum) or of another hash or format; never throws for
/// these.
std::optional<StateRecord> read_state(const std::filesystem::path& file, const std::string& hash);

}  // namespace softreel::assets
