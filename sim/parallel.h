#pragma once
// Parallel loops whose results do not depend on the number of threads: work is split statically, sums are
// formed over chunks of fixed size and added in order.
#include <algorithm>
#include <vector>

namespace softreel::sim {

/// Loops shorter than this run on the calling thread: waking the others costs more than the work.
inline constexpr int kSerialBelow = 512;

/// Calls body(i) for i in [0, n); body must write only what belongs to i.
template <class Body>
void parallel_for(int n, const Body& body) {
  if (n < kSerialBelow) {
    for (int i = 0; i < n; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static)
  for (int i = 0; i < n; ++i) body(i);
}

/// Sum of body(i) over [0, n), the same bits for any number of threads.
template <class Body>
double parallel_sum(int n, const Body& body) {
  constexpr int kChunk = 1024;
  const int chunks = (n + kChunk - 1) / kChunk;
  auto chunk_sum = [&](int c) {
    double sum = 0;
    const int end = std::min(n, (c + 1) * kChunk);
    for (int i = c * kChunk; i < end; ++i) sum += body(i);
    return sum;
  };
  if (chunks <= 1) return n > 0 ? chunk_sum(0) : 0.0;
  std::vector<double> sums(static_cast<size_t>(chunks));
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) sums[static_cast<size_t>(c)] = chunk_sum(c);
  double total = 0;
  for (double s : sums) total += s;
  return total;
}

}  // namespace softreel::sim
