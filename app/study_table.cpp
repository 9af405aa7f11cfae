#include "app/study_table.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/study_summary.h"

namespace softreel::app {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string cell(double value) { return fmt::format("{:.6g}", value); }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : std::string(); }

}  // namespace

std::string study_csv(const std::vector<StudyRow>& rows, const StudyReference& reference) {
  std::string text =
      "method,settings,now,step_s,status,failed_frame,failed_time_s,failed_step,why,"
      "worst_rms_m,worst_rms_fraction,end_rms_m,clip_rms_m,largest_m,end_rms_px,largest_px,"
      "energy_drift,momentum_drift,angular_momentum_drift,volume_change,penetration_m,pins_m,"
      "wall_s,processor_s,setup_s,gradient_s,assemble_s,solve_s,contact_s,other_s,repeats,"
      "steps,newton_iterations,linear_iterations,retried_steps,peak_memory_bytes,vertices\n";
  for (const StudyRow& r : rows) {
    std::vector<std::string> c = {quoted(r.method), quoted(r.label), r.present ? "yes" : "", cell(r.step),
                                  r.done() ? "done" : r.status()};
    if (r.failure) {
      c.push_back(r.run ? fmt::format("{}", r.failure->frame) : "");
      c.push_back(r.run ? cell(r.failure->time) : "");
      c.push_back(r.run ? fmt::format("{}", r.failure->step) : "");
      c.push_back(quoted(r.failure->why));
    } else {
      c.resize(c.size() + 4);
    }
    if (r.errors) {
      const PositionErrors& e = *r.errors;
      for (const double v : {e.worst, e.worst / reference.size, e.end, e.clip, e.largest, e.end_px, e.largest_px})
        c.push_back(cell(v));
    } else {
      c.resize(c.size() + 7);
    }
    const Drifts& d = r.drifts;
    for (const auto& v : {d.energy, d.momentum, d.angular, d.volume, d.penetration, d.pins}) c.push_back(cell(v));
    if (r.run) {
      for (const double v : {r.wall, r.processor, r.setup, r.stages.gradient, r.stages.assemble, r.stages.solve,
                             r.stages.contact, r.stages.other()})
        c.push_back(cell(v));
      c.push_back(fmt::format("{}", r.repeats));
      for (const long v : {r.steps, r.newton, r.linear, r.retries, r.peak_memory, r.vertices})
        c.push_back(fmt::format("{}", v));
    } else {
      c.resize(c.size() + 15);
    }
    text += fmt::format("{}\n", fmt::join(c, ","));
  }
  return text;
}

std::string study_json(const StudyHead& head, const std::vector<StudyRow>& rows, const StudyReference& reference) {
  using nlohmann::json;
  json j = {{"scene", head.scene},       {"command", head.command},
            {"machine", head.machine},   {"threads", head.threads},
            {"versions", head.versions}, {"budget_seconds", head.budget},
            {"size_m", reference.size},  {"reference", {{"what", reference.what}, {"floor_m", reference.floor}}}};
  if (reference.order > 0) j["reference"]["observed_order"] = reference.order;
  if (!head.warning.empty()) j["warning"] = head.warning;
  j["orders"] = json::object();
  j["rows"] = json::array();
  for (const StudyRow& r : rows) {
    json row = json::parse(row_json(r));
    row["method"] = r.method;
    row["label"] = r.label;
    row["integrator"] = r.integrator;
    row["now"] = r.present;
    row["step"] = r.step;
    row["settings"] = json::object();
    for (const auto& [key, value] : r.settings) row["settings"][key] = value;
    if (const auto order = observed_order(rows, r.method, reference.floor, reference.size))
      j["orders"][r.method] = *order;
    j["rows"].push_back(std::move(row));
  }
  return j.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string machine_text() {
  std::ifstream info("/proc/cpuinfo");
  std::string model = "unknown processor";
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  return fmt::format("{}, {} threads", model, std::thread::hardware_concurrency());
}

}  // namespace softreel::app
