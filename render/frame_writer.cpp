#include "render/frame_writer.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace softreel::render {

struct FrameWriter::State {
  struct Job {
    std::filesystem::path path;
    Image image;
    PngText text;
  };

  std::size_t capacity = 1;
  mutable std::mutex mutex;
  std::condition_variable job_added;
  std::condition_variable job_taken;
  std::deque<Job> queue;
  bool closed = false;
  std::exception_ptr first_error;
  std::size_t written = 0;
  double seconds = 0;
  std::vector<std::jthread> threads;

  void work() {
    for (;;) {
      std::unique_lock lock(mutex);
      job_added.wait(lock, [&] { return closed || !queue.empty(); });
      if (queue.empty()) return;
      const Job job = std::move(queue.front());
      queue.pop_front();
      const bool skip = first_error != nullptr;
      lock.unlock();
      job_taken.notify_one();
      if (!skip) run(job);
    }
  }

  void run(const Job& job) {
    const auto begin = std::chrono::steady_clock::now();
    std::exception_ptr error;
    try {
      write_png(job.path, job.image, job.text);
    } catch (...) {
      error = std::current_exception();
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    const std::lock_guard lock(mutex);
    seconds += spent.count();
    if (error && !first_error) first_error = error;
    if (!error) ++written;
  }

  void close_and_join() {
    {
      const std::lock_guard lock(mutex);
      closed = true;
    }
    job_added.notify_all();
    threads.clear();
  }
};

FrameWriter::FrameWriter(int threads, std::size_t capacity) : state_(std::make_unique<State>()) {
  state_->capacity = std::max<std::size_t>(capacity, 1);
  for (int i = 0; i < std::max(threads, 1); ++i)
    state_->threads.emplace_back([state = state_.get()] { state->work(); });
}

FrameWriter::~FrameWriter() { state_->close_and_join(); }

void FrameWriter::write(std::filesystem::path path, Image image, PngText text) {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  if (s.closed) throw std::logic_error("FrameWriter: write after finish");
  s.job_taken.wait(lock, [&] { return s.first_error || s.queue.size() < s.capacity; });
  if (s.first_error) std::rethrow_exception(s.first_error);
  s.queue.push_back({std::move(path), std::move(image), std::move(text)});
  lock.unlock();
  s.job_added.notify_one();
}

void FrameWriter::finish() {
  state_->close_and_join();
  if (state_->first_error) std::rethrow_exception(state_->first_error);
}

std::size_t FrameWriter::frames_written() const {
  const std::lock_guard lock(state_->mutex);
  return state_->written;
}

double FrameWriter::encode_seconds() const {
  const std::lock_guard lock(state_->mutex);
  return state_->seconds;
}

}  // namespace softreel::render
