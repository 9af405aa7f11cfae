#include "app/clip_cache.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/frame_range.h"
#include "assets/atomic_file.h"
#include "assets/state_file.h"

namespace softreel::app {
namespace {

std::vector<double> to_vector(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }
Eigen::VectorXd to_eigen(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

constexpr std::array<std::pair<const char*, double ContactFigures::*>, 9> kContactFigures = {{
    {"contact/candidates", &ContactFigures::candidates},
    {"contact/active", &ContactFigures::active},
    {"contact/smallest_gap", &ContactFigures::smallest_gap},
    {"contact/deepest", &ContactFigures::deepest},
    {"contact/crossings", &ContactFigures::crossings},
    {"contact/sticks", &ContactFigures::sticks},
    {"contact/slips", &ContactFigures::slips},
    {"contact/stiffenings", &ContactFigures::stiffenings},
    {"contact/stiffening_energy", &ContactFigures::stiffening_energy},
}};

}  // namespace

ClipCache::ClipCache(std::filesystem::path folder, std::string simulation_hash)
    : folder_(std::move(folder) / ("sim_" + simulation_hash)), hash_(std::move(simulation_hash)) {}

ClipCache ClipCache::beside(const std::string& name) const {
  return ClipCache(folder_.parent_path(), hash_ + "_" + name);
}

void ClipCache::remove() const {
  std::error_code ignored;  // what cannot be removed is only in the way
  std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path ClipCache::file(int frame) const { return folder_ / frame_file_name(frame, "state"); }
std::string ClipCache::hash_of(int frame) const { return fmt::format("{}/{}", hash_, frame); }

void ClipCache::write(int frame, const CachedFrame& data) const {
  assets::make_folders(folder_);
  assets::StateRecord record;
  record.arrays["x"] = to_vector(data.state.x);
  record.arrays["v"] = to_vector(data.state.v);
  record.arrays["memory"] = data.memory;
  if (data.contact_force.size() > 0) record.arrays["contact_force"] = to_vector(data.contact_force);
  const sim::Energies& e = data.figures.energies;
  record.scalars = {{"t", data.state.t},
                    {"energy/kinetic", e.kinetic},
                    {"energy/elastic", e.elastic},
                    {"energy/gravity", e.gravity},
                    {"energy/contact", e.contact},
                    {"energy/dissipated", e.dissipated},
                    {"steps", data.figures.steps},
                    {"newton_iterations", data.figures.newton_iterations},
                    {"linear_iterations", data.figures.linear_iterations},
                    {"retried_steps", data.figures.retried_steps},
                    {"residual", data.figures.residual},
                    {"inverted", data.figures.inverted}};
  if (const std::optional<FrameAccuracy>& a = data.figures.accuracy) {
    record.scalars["accuracy/estimate"] = a->estimate;
    record.scalars["accuracy/coarse_steps"] = a->coarse_steps;
    record.scalars["accuracy/met"] = a->met ? 1 : 0;
  }
  if (data.figures.momentum_drift) record.scalars["momentum_drift"] = *data.figures.momentum_drift;
  if (data.figures.asleep) record.scalars["asleep"] = *data.figures.asleep;
  if (data.figures.contact)
    for (const auto& [name, figure] : kContactFigures) record.scalars[name] = *data.figures.contact.*figure;
  for (std::size_t i = 0; i < data.fields.size(); ++i) {
    const std::string name = fmt::format("field/{}/", i + 1);
    record.arrays[name + "value"] = to_vector(data.fields[i].value);
    record.arrays[name + "rate"] = to_vector(data.fields[i].rate);
    record.arrays[name + "memory"] = data.fields[i].memory;
  }
  if (!data.fields.empty()) record.scalars["fields"] = static_cast<double>(data.fields.size());
  assets::write_state(file(frame), hash_of(frame), record);
}

std::optional<CachedFrame> ClipCache::read(int frame, int vertices) const {
  const std::optional<assets::StateRecord> record = assets::read_state(file(frame), hash_of(frame));
  if (!record) return std::nullopt;
  CachedFrame data;
  try {
    data.state.x = to_eigen(record->arrays.at("x"));
    data.state.v = to_eigen(record->arrays.at("v"));
    data.memory = record->arrays.at("memory");
    if (const auto force = record->arrays.find("contact_force"); force != record->arrays.end())
      data.contact_force = to_eigen(force->second);
    const auto& s = record->scalars;
    data.state.t = s.at("t");
    data.figures.energies = {s.at("energy/kinetic"), s.at("energy/elastic"), s.at("energy/gravity"),
                             s.at("energy/contact"), s.at("energy/dissipated")};
    data.figures.steps = s.at("steps");
    data.figures.newton_iterations = s.at("newton_iterations");
    data.figures.linear_iterations = s.at("linear_iterations");
    data.figures.retried_steps = s.at("retried_steps");
    data.figures.residual = s.at("residual");
    data.figures.inverted = s.at("inverted");
    if (s.contains("accuracy/met"))
      data.figures.accuracy = {s.at("accuracy/estimate"), s.at("accuracy/coarse_steps"), s.at("accuracy/met") != 0};
    if (s.contains("momentum_drift")) data.figures.momentum_drift = s.at("momentum_drift");
    if (s.contains("asleep")) data.figures.asleep = s.at("asleep");
    if (s.contains(kContactFigures.front().first)) {
      data.figures.contact.emplace();
      for (const auto& [name, figure] : kContactFigures) *data.figures.contact.*figure = s.at(name);
    }
    const auto fields = s.find("fields");
    data.fields.resize(fields == s.end() ? 0 : static_cast<std::size_t>(fields->second));
    for (std::size_t i = 0; i < data.fields.size(); ++i) {
      const std::string name = fmt::format("field/{}/", i + 1);
      data.fields[i].value = to_eigen(record->arrays.at(name + "value"));
      data.fields[i].rate = to_eigen(record->arrays.at(name + "rate"));
      data.fields[i].memory = record->arrays.at(name + "memory");
    }
  } catch (const std::out_of_range&) {
    return std::nullopt;  // written by another version
  }
  const Eigen::Index size = data.state.x.size();
  if (data.state.v.size() != size || (vertices >= 0 && size != 3 * static_cast<Eigen::Index>(vertices)))
    return std::nullopt;
  return data;
}

int ClipCache::complete_frames(int last) const {
  int frame = 0;
  while (frame < last && read(frame + 1)) ++frame;
  return frame;
}

}  // namespace softreel::app
