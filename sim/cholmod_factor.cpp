#include "sim/cholmod_factor.h"

#include <cholmod.h>

#include <cmath>
#include <limits>
#include <new>
#include <string>

#include "sim/blas.h"
#include "sim/linear_input.h"

namespace softreel::sim {

struct CholmodFactor::Impl {
  cholmod_common common;
  cholmod_sparse* A = nullptr;  // lower triangle, scalar
  cholmod_factor* L = nullptr;
  std::vector<int> block_of;  // for each block column, its blocks (j >= i) in order: positions in the BlockMatrix
  std::vector<int> block_first;
  const BlockMatrix* matrix_ = nullptr;
  std::string failure;  // of the last factorization

  explicit Impl(CholmodKind kind) {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = kind == CholmodKind::kSupernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common.final_ll = kind == CholmodKind::kSupernodal ? 1 : 0;
    use_single_threaded_blas();
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

  /// What is left of a diagonal entry when the rows before have been eliminated is a difference: where it is below the
  /// rounding of that difference, the pivot means nothing, and the matrix is singular as far as the numbers tell.
  bool singular() const {
    const auto n = static_cast<size_t>(A->nrow);
    const auto* permutation = static_cast<const int*>(L->Perm);
    const auto* column = static_cast<const int*>(A->p);
    const auto* value = static_cast<const double*>(A->x);
    const auto* factor = static_cast<const double*>(L->x);
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(n));
    const auto lost = [&](size_t j, double pivot) {
      // The lower triangle by columns: the diagonal entry comes first.
      return !(std::abs(pivot) > rounding * std::abs(value[column[permutation[j]]]));
    };
    if (!L->is_super) {
      const auto* first = static_cast<const int*>(L->p);
      for (size_t j = 0; j < n; ++j)
        if (lost(j, factor[first[j]])) return true;
      return false;
    }
    const auto* columns = static_cast<const int*>(L->super);
    const auto* rows = static_cast<const int*>(L->pi);
    const auto* values = static_cast<const int*>(L->px);
    for (size_t s = 0; s < L->nsuper; ++s) {
      const auto height = static_cast<size_t>(rows[s + 1] - rows[s]);
      for (int j = columns[s]; j < columns[s + 1]; ++j) {
        const double l = factor[static_cast<size_t>(values[s]) + static_cast<size_t>(j - columns[s]) * (height + 1)];
        if (lost(static_cast<size_t>(j), l * l)) return true;
      }
    }
    return false;
  }

  void factorize(const BlockMatrix& matrix) {
    matrix_ = &matrix;
    copy_values(matrix);
    failure.clear();
    if (cholmod_factorize(A, L, &common) && common.status == CHOLMOD_OK && L->minor == L->n) {
      if (singular()) failure = kSingular;
    } else if (common.status == CHOLMOD_OUT_OF_MEMORY) {
      failure = "not enough memory for the factor";
    } else {
      failure = common.supernodal == CHOLMOD_SUPERNODAL ? kNotPositiveDefinite : kSingular;
    }
  }
};

CholmodFactor::CholmodFactor(CholmodKind kind) : impl_(std::make_unique<Impl>(kind)) {}
CholmodFactor::~CholmodFactor() = default;

void CholmodFactor::analyse(const BlockMatrix& A) { impl_->analyse(A); }
void CholmodFactor::factorize(const BlockMatrix& A) { impl_->factorize(A); }

void CholmodFactor::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearReport& report) {
  if (!impl_->failure.empty()) {
    refuse(report, impl_->failure, *impl_->matrix_, b);
    return;
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
    return;
  }
  x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(solution->x), b.size());
  cholmod_free_dense(&solution, &impl_->common);
  report.ok = x.allFinite();
  if (report.ok) return;
  refuse(report, kSingular, *impl_->matrix_, b);
}

double CholmodFactor::flops() const { return impl_->common.fl; }
double CholmodFactor::nonzeros() const { return impl_->common.lnz; }
std::size_t CholmodFactor::bytes() const {
  return impl_->common.memory_usage + sizeof(int) * (impl_->block_of.size() + impl_->block_first.size());
}
bool CholmodFactor::analysed() const { return impl_->L != nullptr; }

}  // namespace softreel::sim
