#include "sim/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <thread>

namespace softreel::sim {
namespace {

int thread_count = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

}  // namespace

void set_threads(int threads) {
  thread_count = std::max(1, threads);
  // The one limit of the process, replaced by the next call.
  static std::unique_ptr<tbb::global_control> limit;
  limit.reset();
  limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                static_cast<size_t>(thread_count));
}

int threads() { return thread_count; }

void run_tasks(int count, void (*task)(const void* context, int k), const void* context) {
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int k = range.begin(); k < range.end(); ++k) task(context, k);
      },
      tbb::simple_partitioner());
}

}  // namespace softreel::sim
