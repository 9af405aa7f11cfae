#include "app/video.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/external_program.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "assets/atomic_file.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;

constexpr std::array kContainers = {".mp4", ".mov", ".mkv", ".m4v"};

}  // namespace

void check_video(const std::filesystem::path& video) {
  const std::string extension = video.extension().string();
  if (std::find(kContainers.begin(), kContainers.end(), extension) == kContainers.end())
    throw UserError(ErrorKind::kUsage,
                    fmt::format("--video {}: the name has to end in .mp4, .mov, .m4v or .mkv", video.string()));
  if (find_program("ffmpeg").empty())
    throw UserError(ErrorKind::kInput,
                    "--video needs the program ffmpeg, and there is none in PATH (Debian: apt install "
                    "ffmpeg); without --video the frames are written all the same");
  check_output_file(video);
}

void write_video(const std::filesystem::path& video, const std::vector<std::filesystem::path>& frames, double fps) {
  // The temporary name keeps the extension: ffmpeg takes the container from it.
  const std::filesystem::path temporary =
      video.parent_path() / fmt::format(".{}.{}{}", video.stem().string(), getpid(), video.extension().string());
  const RemovedAtEnd removed{temporary};
  std::vector<std::string> arguments = {
      "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y", "-f", "image2pipe", "-c:v", "png", "-framerate",
      fmt::format("{:.10g}", fps), "-i", "pipe:0", "-vf",
      // The colour planes have half the size: even sides, at least 2.
      "pad=max(2\\,iw):max(2\\,ih),crop=max(2\\,trunc(iw/2)*2):max(2\\,trunc(ih/2)*2):0:0,scale=out_color_matrix="
      "bt709:out_range=tv,format=yuv420p",
      "-c:v", "libx264", "-preset", "medium", "-crf", "18", "-colorspace", "bt709", "-color_primaries", "bt709",
      "-color_trc", "bt709", "-color_range", "tv", "-movflags", "+faststart",
      // Without "file:" a colon in the name would be a protocol.
      "file:" + temporary.string()};
  PipeTo ffmpeg(arguments, stop_if_interrupted);
  bool reading = true;
  for (const std::filesystem::path& frame : frames) {
    stop_if_interrupted();
    const std::string bytes = assets::read_file(frame);
    reading = ffmpeg.write(bytes.data(), bytes.size());
    if (!reading) break;
  }
  const int code = ffmpeg.finish();
  if (code != 0 || !reading)
    throw UserError(ErrorKind::kOutput, video.string(),
                    fmt::format("ffmpeg could not write the video (exit code {}): {}. The frames are complete", code,
                                ffmpeg.complaint()));
  std::error_code error;
  std::filesystem::rename(temporary, video, error);
  if (error)
    throw UserError(ErrorKind::kOutput, video.string(), "the video could not be put in place: " + error.message());
}

}  // namespace softreel::app
