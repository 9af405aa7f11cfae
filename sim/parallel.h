#pragma once
// Parallel loops whose results do not depend on the number of threads: everybody writes what is his own, sums are
// formed over chunks of fixed size and added in order.
#include <algorithm>
#include <vector>

namespace softreel::sim {

/// Shorter loops run on the calling thread: waking the others costs some microseconds, and far more where other
/// programs hold the processors.
enum class Work : int {
  kElement = 128,  ///< hundreds of nanoseconds each: an element's Hessian
  kRow = 1024,     ///< tens of nanoseconds each: a row of a matrix, an element's energy
  kVector = 8192,  ///< some nanoseconds each: an entry of a vector
};

/// Threads that the physics uses from now on; >= 1. At first: as many as the machine has.
void set_threads(int threads);
int threads();

/// Calls task(context, k) for k in [0, count), in any order, on any thread. A thread that waits takes over what another
/// has not begun: on a busy machine nobody waits for a thread that was put aside.
void run_tasks(int count, void (*task)(const void* context, int k), const void* context);

/// Calls body(k) for k in [0, count), each a task of its own.
template <class Body>
void parallel_tasks(int count, const Body& body) {
  run_tasks(
      count, [](const void* context, int k) { (*static_cast<const Body*>(context))(k); }, &body);
}

/// Calls body(i) for i in [0, n); body must write only what belongs to i.
template <class Body>
void parallel_for(int n, Work work, const Body& body) {
  if (n < static_cast<int>(work) || threads() == 1) {
    for (int i = 0; i < n; ++i) body(i);
    return;
  }
  const int tasks = 4 * threads();
  parallel_tasks(tasks, [&](int k) {
    const auto bound = [&](int j) { return static_cast<int>(static_cast<long>(n) * j / tasks); };
    for (int i = bound(k); i < bound(k + 1); ++i) body(i);
  });
}

/// Sum of body(i) over [0, n), the same bits for any number of threads.
template <class Body>
double parallel_sum(int n, Work work, const Body& body) {
  constexpr int kChunk = 1024;
  const int chunks = (n + kChunk - 1) / kChunk;
  auto chunk_sum = [&](int c) {
    double sum = 0;
    const int end = std::min(n, (c + 1) * kChunk);
    for (int i = c * kChunk; i < end; ++i) sum += body(i);
    return sum;
  };
  double total = 0;
  if (n < static_cast<int>(work) || chunks < 2 || threads() == 1) {
    for (int c = 0; c < chunks; ++c) total += chunk_sum(c);
    return total;
  }
  std::vector<double> sums(static_cast<size_t>(chunks));
  parallel_tasks(chunks, [&](int c) { sums[static_cast<size_t>(c)] = chunk_sum(c); });
  for (double s : sums) total += s;
  return total;
}

}  // namespace softreel::sim
