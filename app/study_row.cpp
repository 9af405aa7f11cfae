#include "app/study_row.h"

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "assets/atomic_file.h"
#include "assets/error.h"
#include "assets/state_file.h"

namespace softreel::app {
namespace {

using nlohmann::json;

/// JSON has no infinity: null.
json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
double number_of(const json& j) { return j.is_null() ? std::numeric_limits<double>::infinity() : j.get<double>(); }

constexpr const char* kEnds[] = {"refused", "failed", "blew up", "out of budget"};

constexpr std::array<std::pair<const char*, double PositionErrors::*>, 6> kErrors = {{
    {"end_rms_m", &PositionErrors::end},
    {"clip_rms_m", &PositionErrors::clip},
    {"worst_rms_m", &PositionErrors::worst},
    {"largest_m", &PositionErrors::largest},
    {"end_rms_px", &PositionErrors::end_px},
    {"largest_px", &PositionErrors::largest_px},
}};

constexpr std::array<std::pair<const char*, std::optional<double> Drifts::*>, 6> kDrifts = {{
    {"energy", &Drifts::energy},
    {"momentum", &Drifts::momentum},
    {"angular_momentum", &Drifts::angular},
    {"volume", &Drifts::volume},
    {"penetration_m", &Drifts::penetration},
    {"pins_m", &Drifts::pins},
}};

json errors_json(const PositionErrors& e) {
  json j = json::object();
  for (const auto& [name, figure] : kErrors) j[name] = number(e.*figure);
  return j;
}

PositionErrors errors_of(const json& j) {
  PositionErrors e;
  for (const auto& [name, figure] : kErrors) e.*figure = number_of(j.at(name));
  return e;
}

json drifts_json(const Drifts& d) {
  json j = json::object();
  for (const auto& [name, figure] : kDrifts)
    if (d.*figure) j[name] = number(*(d.*figure));
  return j;
}

Drifts drifts_of(const json& j) {
  Drifts d;
  for (const auto& [name, figure] : kDrifts)
    if (j.contains(name)) d.*figure = number_of(j.at(name));
  return d;
}

}  // namespace

std::string StudyRow::status() const { return failure ? kEnds[static_cast<size_t>(failure->end)] : std::string(); }

std::string row_json(const StudyRow& r) {
  json j = {{"run", r.run},
            {"repeats", r.repeats},
            {"seconds", {{"wall", r.wall}, {"processor", r.processor}, {"setup", r.setup}}},
            {"stages",
             {{"gradient", r.stages.gradient},
              {"assemble", r.stages.assemble},
              {"solve", r.stages.solve},
              {"contact", r.stages.contact},
              {"total", r.stages.total}}},
            {"steps", r.steps},
            {"newton_iterations", r.newton},
            {"linear_iterations", r.linear},
            {"retried_steps", r.retries},
            {"peak_memory_bytes", r.peak_memory},
            {"vertices", r.vertices},
            {"drifts", drifts_json(r.drifts)}};
  j["energy_change"] = json::array();
  for (const double e : r.energy) j["energy_change"].push_back(number(e));
  if (r.errors) j["errors"] = errors_json(*r.errors);
  if (r.failure)
    j["failure"] = {{"kind", r.status()},
                    {"frame", r.failure->frame},
                    {"time", r.failure->time},
                    {"step", r.failure->step},
                    {"why", r.failure->why}};
  return j.dump(1, ' ', false, json::error_handler_t::replace);
}

bool parse_row_json(const std::string& text, StudyRow& row) {
  try {
    const json j = json::parse(text);
    StudyRow r = row;
    r.run = j.at("run");
    r.repeats = j.at("repeats");
    r.wall = j.at("seconds").at("wall");
    r.processor = j.at("seconds").at("processor");
    r.setup = j.at("seconds").at("setup");
    const json& s = j.at("stages");
    r.stages = {s.at("gradient"), s.at("assemble"), s.at("solve"), s.at("contact"), s.at("total")};
    r.steps = j.at("steps");
    r.newton = j.at("newton_iterations");
    r.linear = j.at("linear_iterations");
    r.retries = j.at("retried_steps");
    r.peak_memory = j.at("peak_memory_bytes");
    r.vertices = j.at("vertices");
    r.drifts = drifts_of(j.at("drifts"));
    for (const json& e : j.at("energy_change")) r.energy.push_back(number_of(e));
    if (j.contains("errors")) r.errors = errors_of(j.at("errors"));
    if (j.contains("failure")) {
      const json& f = j.at("failure");
      TrialFailure failure{TrialEnd::kFailed, f.at("frame"), f.at("time"), f.at("step"), f.at("why")};
      for (size_t i = 0; i < std::size(kEnds); ++i)
        if (f.at("kind") == kEnds[i]) failure.end = static_cast<TrialEnd>(i);
      r.failure = failure;
    }
    row = std::move(r);
    return true;
  } catch (const json::exception&) {
    return false;  // written by another version, or damaged
  }
}

void StudyStore::write(const std::string& hash, const StudyRow& row, const CachedFrame* last) const {
  assets::make_folders(folder_);
  if (last) {
    assets::StateRecord record;
    record.arrays["x"] = {last->state.x.data(), last->state.x.data() + last->state.x.size()};
    record.scalars["t"] = last->state.t;
    assets::write_state(folder_ / (hash + ".state"), hash, record);
  }
  assets::write_file_atomically(folder_ / (hash + ".json"), row_json(row));
}

bool StudyStore::read(const std::string& hash, StudyRow& row) const {
  const std::filesystem::path file = folder_ / (hash + ".json");
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  try {
    return parse_row_json(assets::read_file(file), row);
  } catch (const assets::UserError&) {
    return false;  // it is measured again
  }
}

std::optional<CachedFrame> StudyStore::last_frame(const std::string& hash) const {
  const auto record = assets::read_state(folder_ / (hash + ".state"), hash);
  if (!record || !record->arrays.contains("x") || !record->scalars.contains("t")) return std::nullopt;
  CachedFrame frame;
  const std::vector<double>& x = record->arrays.at("x");
  frame.state.x = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  frame.state.t = record->scalars.at("t");
  return frame;
}

}  // namespace softreel::app
