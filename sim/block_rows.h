#pragma once
// Rows of a product with 3x3 blocks, a column of a block at a time in one vector register.
#include <cstring>
#include <span>

namespace softreel::sim {

template <class Scalar>
struct FourOf {
  typedef Scalar Type __attribute__((vector_size(4 * sizeof(Scalar))));
};

/// Block rows [first, first + count) of y = A x; `values`: 9 a block, column-major, and one more that can be read at
/// the end of the last: a column is loaded with the entry after it, which goes nowhere.
template <class Scalar>
void multiply_block_rows(std::span<const int> row_start, std::span<const int> column, const Scalar* values, int first,
                         int count, const Scalar* x, Scalar* y) {
  using Four = typename FourOf<Scalar>::Type;
  const auto load = [](const Scalar* a) {
    Four entries;
    std::memcpy(&entries, a, sizeof(entries));
    return entries;
  };
  for (int i = first; i < first + count; ++i) {
    const int begin = row_start[static_cast<size_t>(i)], end = row_start[static_cast<size_t>(i) + 1];
    const Scalar* a = values + 9 * static_cast<size_t>(begin);
    Four sum0{}, sum1{}, sum2{};
    for (int k = begin; k < end; ++k, a += 9) {
      const Scalar* p = x + 3 * static_cast<size_t>(column[static_cast<size_t>(k)]);
      sum0 += load(a) * p[0];
      sum1 += load(a + 3) * p[1];
      sum2 += load(a + 6) * p[2];
    }
    const Four sum = sum0 + sum1 + sum2;
    for (int r = 0; r < 3; ++r) y[3 * i + r] = sum[r];
  }
}

}  // namespace softreel::sim
