#pragma once

namespace softreel::sim {

/// Keeps OpenBLAS and CHOLMOD on the calling thread, for the whole program. To be called before their first use.
void use_single_threaded_blas();

}  // namespace softreel::sim
