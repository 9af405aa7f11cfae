#pragma once
// Parallel loops whose results do not depend on the number of threads: work is split statically, sums are
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

/// Calls body(i) for i in [0, n); body must write only what belongs to i.
template <class Body>
void parallel_for(int n, Work work, const Body& body) {
  if (n < static_cast<int>(work)) {
    for (int i = 0; i < n; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static)
  for (int i = 0; i < n; ++i) body(i);
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
  if (n < static_cast<int>(work) || chunks < 2) {
    double total = 0;
    for (int c = 0; c < chunks; ++c) total += chunk_sum(c);
    return total;
  }
  std::vector<double> sums(static_cast<size_t>(chunks));
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) sums[static_cast<size_t>(c)] = chunk_sum(c);
  double total = 0;
  for (double s : sums) total += s;
  return total;
}

}  // namespace softreel::sim
