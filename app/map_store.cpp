#include "app/map_store.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "app/hashes.h"
#include "assets/atomic_file.h"
#include "assets/content_hash.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

constexpr int kVersion = 1;  // raised when cells come out different

}  // namespace

std::string MapStore::hash_of(const assets::Scene& scene) {
  assets::ContentHasher hasher;
  hasher.add(kVersion).add(simulation_hash(scene)).add(scene.time.frames());
  return hasher.hex();
}

void MapStore::write(const std::string& hash, const MapCell& cell) const {
  assets::make_folders(folder_);
  const nlohmann::json j = {{"outcome", outcome_name(cell.outcome)},
                            {"energy_change", cell.energy_change},
                            {"step_over_limit", cell.step_over_limit},
                            {"why", cell.why}};
  assets::write_file_atomically(file(hash), j.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::optional<MapCell> MapStore::read(const std::string& hash) const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file(hash), error)) return std::nullopt;
  try {
    const nlohmann::json j = nlohmann::json::parse(assets::read_file(file(hash)));
    MapCell cell;
    cell.energy_change = j.at("energy_change");
    cell.step_over_limit = j.at("step_over_limit");
    cell.why = j.at("why");
    for (const Outcome outcome : kMeasured)
      if (j.at("outcome") == outcome_name(outcome)) {
        cell.outcome = outcome;
        return cell;
      }
  } catch (const nlohmann::json::exception&) {  // damaged: it is measured again
  } catch (const assets::UserError&) {
  }
  return std::nullopt;
}

}  // namespace softreel::app
