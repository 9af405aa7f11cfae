#include "app/turntable_pictures.h"

#include <fmt/format.h>

#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/frame_range.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "app/progress.h"
#include "app/video.h"
#include "render/frame_writer.h"

namespace softreel::app {

std::filesystem::path turntable_output(const TurntableArguments& a) {
  if (!a.video.empty()) check_video(a.video);
  const std::filesystem::path output =
      a.output.empty() ? std::filesystem::path("out") / (std::filesystem::path(a.mesh).stem().string() + "-turntable")
                       : std::filesystem::path(a.output);
  check_output_folder(output);
  return output;
}

int write_turntable(const TurntableArguments& a, const std::filesystem::path& output, const std::string& driver,
                    const std::function<render::Image(double angle)>& picture) {
  render::FrameWriter writer(1);
  std::vector<std::filesystem::path> files;
  {
    Progress progress("turntable", a.count, a.quiet);
    for (int i = 0; i < a.count && !interrupted(); ++i) {
      files.push_back(output / frame_file_name(i + 1));
      writer.write(files.back(), picture(360.0 * i / a.count),
                   {{"Software", "softreel " + version()},
                    {"softreel:frame", std::to_string(i + 1)},
                    {"softreel:driver", driver}});
      progress.advance();
    }
  }
  writer.finish();
  stop_if_interrupted();
  if (!a.video.empty()) write_video(a.video, files, a.fps);
  if (!a.quiet) fmt::print("{}\n{}\n", files.front().string(), a.video.empty() ? files.back().string() : a.video);
  return kDone;
}

}  // namespace softreel::app
