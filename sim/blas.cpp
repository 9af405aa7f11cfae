#include "sim/blas.h"

extern "C" void openblas_set_num_threads(int threads);
extern "C" void omp_set_max_active_levels(int levels);

namespace softreel::sim {

void use_single_threaded_blas() {
  openblas_set_num_threads(1);  // two threads of OpenBLAS give other bits than one
  // CHOLMOD asks OpenMP for four threads on every supernode, however small, and they wait by spinning: 0.49 s instead
  // of 0.16 s for a cloth of 16,641 vertices.
  omp_set_max_active_levels(0);
}

}  // namespace softreel::sim
