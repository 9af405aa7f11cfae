#pragma once
// The figures of a run, as JSON (--stats) and as the last lines on the terminal.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/bill.h"
#include "app/clip_cache.h"
#include "app/simulate_clip.h"
#include "render/counters.h"
#include "render/renderer.h"

namespace softreel::app {

struct RunFigures {
  std::string scene, simulation_hash, frame_hash;
  std::vector<BillItem> bill;
  long vertices = 0, triangles = 0, tets = 0;  ///< simulated vertices, drawn triangles, tetrahedra
  long field_vertices = 0;                     ///< of fields
  int frames_asked = 0, frames_rendered = 0, frames_up_to_date = 0;
  bool simulated = false;  ///< a simulation was started in this run
  ClipRun clip;
  std::optional<assets::Accuracy> accuracy;  ///< that was asked for
  render::RenderCounters counters;
  std::vector<render::PictureReport> pictures;  ///< of the frames that were rendered, in their order
  std::vector<FrameFigures> per_frame;          ///< of the clip's frames that were read, from frame 1
  double load = 0, tetrahedralize = 0, render = 0, encode = 0, total = 0;  ///< [s]
};

/// Throws UserError (kOutput).
void write_stats(const std::filesystem::path& file, const RunFigures& run);

/// Where the time went and what was left out, for the end of a run.
std::string summary(const RunFigures& run);

}  // namespace softreel::app
