#pragma once
// Encodes and writes frames on other threads than the one that renders.
#include <cstddef>
#include <filesystem>
#include <memory>

#include "render/image.h"
#include "render/png.h"

namespace softreel::render {

/// Bounded queue of pictures in front of a few encoding threads. The files' bytes do not depend on timing.
class FrameWriter {
 public:
  /// `threads` >= 1; at most `capacity` >= 1 pictures wait.
  explicit FrameWriter(int threads = 1, std::size_t capacity = 4);
  /// Waits for what was accepted; an error that nobody asked for is lost here, so call finish().
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Hands over a picture; waits while the queue is full. Throws the first error of an earlier picture (RenderError,
  /// kOutput); after that nothing more is written.
  void write(std::filesystem::path path, Image image, PngText text = {});
  /// Waits until all is written, joins the threads, throws the first error. May be called again; write() may not.
  void finish();

  std::size_t frames_written() const;
  /// Time spent encoding and writing, summed over the threads [s].
  double encode_seconds() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace softreel::render
