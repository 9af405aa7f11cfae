#pragma once
// Work on many things by several threads, whose results arrive one by one and in order; only a few are ever in the
// making.
#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace softreel::app {

/// `work(i)` for i in [0, count) on `threads` threads (>= 1), `take(i, result)` on the calling thread in the order of
/// i. At most 2 * threads results wait or are in the making. The first exception, in the order of i, ends it and is
/// thrown here.
template <class Work, class Take>
void ordered_work(int count, int threads, Work&& work, Take&& take) {
  using Result = decltype(work(0));
  struct Outcome {
    std::vector<Result> result;  // one, or none where it failed
    std::exception_ptr error;
  };
  std::mutex mutex;
  std::condition_variable changed;
  std::map<int, Outcome> done;
  int next = 0, taken = 0;
  bool stop = false;
  const int ahead = 2 * threads;

  const auto run = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return stop || next == count || next < taken + ahead; });
      if (stop || next == count) return;
      const int i = next++;
      lock.unlock();
      Outcome outcome;
      try {
        outcome.result.push_back(work(i));
      } catch (...) {
        outcome.error = std::current_exception();
      }
      lock.lock();
      done.emplace(i, std::move(outcome));
      changed.notify_all();
    }
  };
  struct Stopper {  // before the threads are joined, however this is left
    std::mutex& mutex;
    std::condition_variable& changed;
    bool& stop;
    ~Stopper() {
      const std::lock_guard lock(mutex);
      stop = true;
      changed.notify_all();
    }
  };
  std::vector<std::jthread> pool;
  const Stopper stopper{mutex, changed, stop};
  for (int t = 0; t < std::min(threads, count); ++t) pool.emplace_back(run);
  for (int i = 0; i < count; ++i) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return done.count(i) > 0; });
    Outcome outcome = std::move(done.extract(i).mapped());
    lock.unlock();
    if (outcome.error) std::rethrow_exception(outcome.error);
    take(i, std::move(outcome.result.front()));
    lock.lock();
    taken = i + 1;
    changed.notify_all();
  }
}

}  // namespace softreel::app
