#include "app/stats.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "assets/atomic_file.h"

namespace softreel::app {
namespace {

long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024L;
}

struct ReachedAccuracy {
  double estimate = 0;  // largest of the frames, in the unit that was asked for
  long coarse_steps = 0, steps = 0;
  bool met = true;
};

/// Nothing if none was asked for, or no frame was read.
std::optional<ReachedAccuracy> reached_accuracy(const RunFigures& run) {
  if (!run.accuracy || run.per_frame.empty() || !run.per_frame.front().accuracy) return std::nullopt;
  ReachedAccuracy reached;
  for (const FrameFigures& f : run.per_frame) {
    if (!f.accuracy) continue;
    reached.estimate = std::max(reached.estimate, f.accuracy->estimate);
    reached.coarse_steps += static_cast<long>(f.accuracy->coarse_steps);
    reached.steps += static_cast<long>(f.steps);
    reached.met = reached.met && f.accuracy->met;
  }
  return reached;
}

}  // namespace

void write_stats(const std::filesystem::path& file, const RunFigures& run) {
  nlohmann::ordered_json j;
  j["scene"] = run.scene;
  j["sim_hash"] = run.simulation_hash;
  if (!run.frame_hash.empty()) j["frame_hash"] = run.frame_hash;
  j["needs"] = nlohmann::ordered_json::array();
  j["left_out"] = nlohmann::ordered_json::object();
  for (const BillItem& item : run.bill) {
    if (item.needed)
      j["needs"].push_back(item.feature);
    else
      j["left_out"][item.feature] = item.why;
  }
  if (!run.clip.solver.empty()) j["solver"]["chosen"] = run.clip.solver;
  if (!run.clip.total.stopped_by.empty()) j["solver"]["stopped_by"] = run.clip.total.stopped_by;
  if (run.clip.total.descent_iterations > 0) j["descent_iterations"] = run.clip.total.descent_iterations;
  // Meshes that this run did not load are not counted.
  if (run.vertices > 0) j["vertices"] = run.vertices;
  if (run.field_vertices > 0) j["field_vertices"] = run.field_vertices;
  if (run.triangles > 0) {
    j["triangles"] = run.triangles;
    j["tets"] = run.tets;
  }
  j["frames"] = run.frames_asked;
  j["frames_rendered"] = run.frames_rendered;
  j["frames_up_to_date"] = run.frames_up_to_date;
  j["frames_simulated"] = run.clip.frames_simulated;
  FrameFigures sum;
  for (const FrameFigures& f : run.per_frame) {
    sum.steps += f.steps;
    sum.newton_iterations += f.newton_iterations;
    sum.linear_iterations += f.linear_iterations;
    sum.retried_steps += f.retried_steps;
  }
  j["steps"] = static_cast<long>(sum.steps);
  j["newton_iterations"] = static_cast<long>(sum.newton_iterations);
  j["linear_iterations"] = static_cast<long>(sum.linear_iterations);
  j["retried_steps"] = static_cast<long>(sum.retried_steps);
  if (const std::optional<ReachedAccuracy> a = reached_accuracy(run)) {
    j["accuracy"] = {{"asked", run.accuracy->value},
                     {"unit", run.accuracy->unit},
                     {"estimate", a->estimate},
                     {"met", a->met},
                     {"steps", static_cast<long>(sum.steps)},
                     {"coarse_steps", a->coarse_steps}};
    for (const FrameFigures& f : run.per_frame)
      j["accuracy"]["per_frame"].push_back(f.accuracy ? f.accuracy->estimate : 0);
  }
  // A stage that was left out is absent.
  const auto seconds = [&](const char* section, const char* stage, double s) {
    if (s > 0) j[section][stage] = s;
  };
  seconds("seconds", "load", run.load);
  seconds("seconds", "tetrahedralize", run.tetrahedralize);
  seconds("seconds", "simulate", run.clip.seconds);
  seconds("seconds", "render", run.render);
  seconds("seconds", "encode", run.encode);
  seconds("seconds", "total", run.total);
  const sim::StageSeconds& s = run.clip.total.seconds;
  seconds("simulate_seconds", "gradient", s.gradient);
  seconds("simulate_seconds", "assemble", s.assemble);
  seconds("simulate_seconds", "solve", s.solve);
  seconds("simulate_seconds", "contact", s.contact);
  seconds("simulate_seconds", "other", run.clip.seconds - s.gradient - s.assemble - s.solve - s.contact);
  const auto counter = [&](const char* what, std::size_t n) {
    if (n > 0) j["render_counters"][what] = n;
  };
  const render::RenderCounters& c = run.counters;
  counter("accumulation_buffers", c.accumulation_buffers);
  counter("shadow_maps", c.shadow_maps);
  counter("textures", c.textures);
  counter("mesh_uploads", c.mesh_uploads);
  counter("passes", c.passes);
  counter("shadow_passes", c.shadow_passes);
  counter("pictures_reused", c.pictures_reused);
  counter("draw_calls", c.draw_calls);
  if (!run.pictures.empty() && run.pictures.front().error)
    for (const render::PictureReport& picture : run.pictures) {
      j["picture"]["samples"].push_back(picture.samples);
      j["picture"]["error_levels"].push_back(picture.error.value_or(0));
    }
  if (run.simulated) j["worst_residual"] = run.clip.total.residual;
  j["peak_memory_bytes"] = peak_memory_bytes();
  for (const char* name : {"kinetic", "elastic", "gravity", "contact", "dissipated"})
    j["energy"][name] = nlohmann::ordered_json::array();
  for (const FrameFigures& f : run.per_frame) {
    j["energy"]["kinetic"].push_back(f.energies.kinetic);
    j["energy"]["elastic"].push_back(f.energies.elastic);
    j["energy"]["gravity"].push_back(f.energies.gravity);
    j["energy"]["contact"].push_back(f.energies.contact);
    j["energy"]["dissipated"].push_back(f.energies.dissipated);
  }
  // What each frame took and how it came out, as the energies: by frame.
  const auto per_frame = [&](const char* name, auto figure) {
    j["per_frame"][name] = nlohmann::ordered_json::array();
    for (const FrameFigures& f : run.per_frame) j["per_frame"][name].push_back(figure(f));
  };
  per_frame("steps", [](const FrameFigures& f) { return static_cast<long>(f.steps); });
  per_frame("newton_iterations", [](const FrameFigures& f) { return static_cast<long>(f.newton_iterations); });
  per_frame("retried_steps", [](const FrameFigures& f) { return static_cast<long>(f.retried_steps); });
  per_frame("residual", [](const FrameFigures& f) { return f.residual; });
  per_frame("inverted_tets", [](const FrameFigures& f) { return static_cast<long>(f.inverted); });
  if (!run.per_frame.empty() && run.per_frame.front().momentum_drift)
    per_frame("momentum_drift", [](const FrameFigures& f) { return f.momentum_drift.value_or(0); });
  if (!run.per_frame.empty() && run.per_frame.front().asleep)
    per_frame("asleep", [](const FrameFigures& f) { return static_cast<long>(f.asleep.value_or(0)); });
  // Where surfaces can touch.
  const auto contact = [&](const char* section, const char* name, double ContactFigures::*figure, bool count) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const FrameFigures& f : run.per_frame) {
      if (!f.contact) return;
      const double value = *f.contact.*figure;
      if (count)
        list.push_back(static_cast<long>(value));
      else
        list.push_back(value);
    }
    if (list.empty()) return;
    if (*section)
      j[section][name] = std::move(list);
    else
      j[name] = std::move(list);
  };
  contact("", "crossings", &ContactFigures::crossings, true);
  contact("contact", "candidates", &ContactFigures::candidates, true);
  contact("contact", "active", &ContactFigures::active, true);
  contact("contact", "smallest_gap", &ContactFigures::smallest_gap, false);
  contact("contact", "deepest", &ContactFigures::deepest, false);
  contact("contact", "sticks", &ContactFigures::sticks, true);
  contact("contact", "slips", &ContactFigures::slips, true);
  contact("contact", "stiffenings", &ContactFigures::stiffenings, true);
  contact("contact", "stiffening_energy", &ContactFigures::stiffening_energy, false);
  // File names may hold any bytes; JSON only UTF-8.
  assets::write_file_atomically(file, j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string summary(const RunFigures& run) {
  std::string text = fmt::format("{:.1f} s in all:", run.total);
  const auto stage = [&](const char* name, double s) {
    if (s >= 0.005) text += fmt::format(" {} {:.2f}", name, s);
  };
  stage("load", run.load);
  stage("tetrahedralize", run.tetrahedralize);
  stage("simulate", run.clip.seconds);
  stage("render", run.render);
  stage("encode", run.encode);
  text += "\nleft out:";
  bool any = false;
  for (const BillItem& item : run.bill)
    if (!item.needed) {
      text += (any ? ", " : " ") + item.feature;
      any = true;
    }
  if (!any) text += " nothing";
  if (run.simulated && run.clip.total.newton_iterations > 0)
    text += fmt::format("\n{} steps, {} retried, {} Newton iterations; worst residual {:.1e} of the forces of its step",
                        run.clip.total.steps, run.clip.total.retries, run.clip.total.newton_iterations,
                        run.clip.total.residual);
  else if (run.simulated && run.clip.total.descent_iterations > 0)
    text += fmt::format("\n{} steps, {} retried, {} iterations of the minimizer; worst residual {:.1e}",
                        run.clip.total.steps, run.clip.total.retries, run.clip.total.descent_iterations,
                        run.clip.total.residual);
  else if (run.simulated)
    text += fmt::format("\n{} steps, {} retried", run.clip.total.steps, run.clip.total.retries);
  if (!run.pictures.empty() && run.pictures.front().error) {
    const auto by_samples = [](const auto& a, const auto& b) { return a.samples < b.samples; };
    const auto [least, most] = std::minmax_element(run.pictures.begin(), run.pictures.end(), by_samples);
    double worst = 0;
    for (const render::PictureReport& picture : run.pictures) worst = std::max(worst, picture.error.value_or(0));
    text += fmt::format("\n{} to {} samples a frame; error of a frame {:.2g} of 255 levels at most, as estimated",
                        least->samples, most->samples, worst);
  }
  if (const std::optional<ReachedAccuracy> a = reached_accuracy(run)) {
    text += fmt::format(
        "\nerror in time: {:.2g} {} at most, as estimated; asked for were {} {}. {} steps, and {} of coarser "
        "runs",
        a->estimate, run.accuracy->unit, run.accuracy->value, run.accuracy->unit, a->steps, a->coarse_steps);
    if (!a->met)
      text +=
          "\nnote: finer steps did not bring the motion closer to one answer (impacts and chaos do that), so the "
          "accuracy is not reached, and the estimate is a guess";
  }
  return text;
}

}  // namespace softreel::app
