#include <cholmod.h>

#include <new>

#include "sim/linear_solver.h"

extern "C" void openblas_set_num_threads(int threads);
extern "C" void omp_set_max_active_levels(int levels);

namespace softreel::sim {

struct CholeskySolver::Impl {
  cholmod_common common;
  cholmod_sparse* A = nullptr;  // lower triangle, scalar
  cholmod_factor* L = nullptr;
  std::vector<int> block_of;  // for each block column, its blocks (j >= i) in order: positions in the BlockMatrix
  std::vector<int> block_first;
  bool factorized = false;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    openblas_set_num_threads(1);  // two threads of OpenBLAS give other bits than one
    // CHOLMOD asks OpenMP for four threads on every supernode, however small, and they wait by spinning: 0.49 s instead
    // of 0.16 s for a cloth of 16,641 vertices.
    omp_set_max_active_levels(0);
  }
  ~Impl() {
    release();
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void release() {
    if (L) cholmod_free_factor(&L, &common);
    if (A) cholmod_free_sparse(&A, &common);
  }

  /// Fill-reducing order of the blocks: three times smaller a graph than that of the scalars, and the same order.
  std::vector<int> order(const BlockMatrix& matrix) {
    const auto n = static_cast<size_t>(matrix.rows());
    cholmod_sparse* graph = cholmod_allocate_sparse(n, n, matrix.column.size(), 1, 1, 1, CHOLMOD_PATTERN, &common);
    if (!graph) throw std::bad_alloc();
    auto* p = static_cast<int*>(graph->p);
    auto* index = static_cast<int*>(graph->i);
    int count = 0;
    for (size_t i = 0; i < n; ++i) {  // upper triangle by columns: column i has rows <= i
      p[i] = count;
      for (int k = matrix.row_start[i]; k <= matrix.diagonal[i]; ++k)
        index[count++] = matrix.column[static_cast<size_t>(k)];
    }
    p[n] = count;
    std::vector<int> permutation(n);
    // Nested dissection pays on large graphs only.
    const int ok = n > 2000 ? cholmod_metis(graph, nullptr, 0, 1, permutation.data(), &common)
                            : cholmod_amd(graph, nullptr, 0, permutation.data(), &common);
    cholmod_free_sparse(&graph, &common);
    if (!ok) throw std::bad_alloc();
    return permutation;
  }

  void analyse(const BlockMatrix& matrix) {
    release();
    const auto n = static_cast<size_t>(matrix.rows());
    block_of.clear();
    block_first.assign(1, 0);
    size_t nonzeros = 0;
    for (size_t i = 0; i < n; ++i) {
      for (int k = matrix.diagonal[i]; k < matrix.row_start[i + 1]; ++k) block_of.push_back(k);
      nonzeros += 9 * (static_cast<size_t>(matrix.row_start[i + 1]) - static_cast<size_t>(matrix.diagonal[i])) - 3;
      block_first.push_back(static_cast<int>(block_of.size()));
    }
    A = cholmod_allocate_sparse(3 * n, 3 * n, nonzeros, 1, 1, -1, CHOLMOD_REAL, &common);
    if (!A) throw std::bad_alloc();
    auto* p = static_cast<int*>(A->p);
    auto* index = static_cast<int*>(A->i);
    int count = 0;
    for (size_t i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) {
        p[3 * i + static_cast<size_t>(c)] = count;
        for (int b = block_first[i]; b < block_first[i + 1]; ++b) {
          const int j = matrix.column[static_cast<size_t>(block_of[static_cast<size_t>(b)])];
          for (int r = static_cast<size_t>(j) == i ? c : 0; r < 3; ++r) index[count++] = 3 * j + r;
        }
      }
    }
    p[3 * n] = count;
    const std::vector<int> blocks = order(matrix);
    std::vector<int> scalars;
    scalars.reserve(3 * n);
    for (int b : blocks) scalars.insert(scalars.end(), {3 * b, 3 * b + 1, 3 * b + 2});
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    L = cholmod_analyze_p(A, scalars.data(), nullptr, 0, &common);
    if (!L) throw std::bad_alloc();
  }

  void copy_values(const BlockMatrix& matrix) {
    auto* value = static_cast<double*>(A->x);
    size_t count = 0;
    for (size_t i = 0; i + 1 < block_first.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        for (int b = block_first[i]; b < block_first[i + 1]; ++b) {
          const int k = block_of[static_cast<size_t>(b)];
          const auto block = matrix.block(k);
          const bool diagonal = k == matrix.diagonal[i];
          for (int r = diagonal ? c : 0; r < 3; ++r) value[count++] = block(c, r);  // A(3j + r, 3i + c)
        }
      }
    }
  }
};

CholeskySolver::CholeskySolver() : impl_(std::make_unique<Impl>()) {}
CholeskySolver::~CholeskySolver() = default;

void CholeskySolver::analyse(const BlockMatrix& A) { impl_->analyse(A); }

void CholeskySolver::factorize(const BlockMatrix& A) {
  impl_->copy_values(A);
  impl_->factorized = cholmod_factorize(impl_->A, impl_->L, &impl_->common) && impl_->common.status == CHOLMOD_OK;
}

LinearReport CholeskySolver::solve(const Eigen::VectorXd& b, const LinearTargets&, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "cholesky";
  if (!impl_->factorized) {
    report.indefinite = impl_->common.status != CHOLMOD_OUT_OF_MEMORY;
    report.reason = impl_->common.status == CHOLMOD_OUT_OF_MEMORY ? "not enough memory for the factor"
                                                                  : "the matrix is not positive definite";
    return report;
  }
  const auto n = static_cast<size_t>(b.size());
  cholmod_dense right{};
  right.nrow = n;
  right.ncol = 1;
  right.nzmax = n;
  right.d = n;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->L, &right, &impl_->common);
  if (!solution) {
    report.reason = "not enough memory for the solution";
    return report;
  }
  x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(solution->x), b.size());
  cholmod_free_dense(&solution, &impl_->common);
  report.ok = x.allFinite();
  if (!report.ok) {
    report.reason = "the solution is not finite";
    report.indefinite = b.allFinite();  // singular up to rounding
  }
  return report;
}

double CholeskySolver::factor_flops() const { return impl_->common.fl; }
double CholeskySolver::factor_nonzeros() const { return impl_->common.lnz; }
bool CholeskySolver::analysed() const { return impl_->L != nullptr; }

}  // namespace softreel::sim
