#include "sim/lu_solver.h"

#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>

#include "sim/blas.h"
#include "sim/linear_input.h"

namespace softreel::sim {

struct LuSolver::Impl {
  // Scalar compressed rows of A: to UMFPACK, which reads columns, they are the transpose.
  std::vector<int> start, column;
  std::vector<double> value;
  void* symbolic = nullptr;
  void* numeric = nullptr;
  double control[UMFPACK_CONTROL];
  double info[UMFPACK_INFO];
  const BlockMatrix* matrix = nullptr;
  std::string failure;
  std::size_t peak = 0;

  Impl() {
    use_single_threaded_blas();
    umfpack_di_defaults(control);
  }
  ~Impl() {
    umfpack_di_free_numeric(&numeric);
    umfpack_di_free_symbolic(&symbolic);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int size() const { return static_cast<int>(start.size()) - 1; }

  void copy_values(const BlockMatrix& A) {
    size_t count = 0;
    for (int i = 0; i < A.rows(); ++i)
      for (int r = 0; r < 3; ++r)
        for (int k = A.row_start[static_cast<size_t>(i)]; k < A.row_start[static_cast<size_t>(i) + 1]; ++k) {
          const auto block = A.block(k);
          for (int c = 0; c < 3; ++c) value[count++] = block(r, c);
        }
  }
};

LuSolver::LuSolver() : impl_(std::make_unique<Impl>()) {}
LuSolver::~LuSolver() = default;

void LuSolver::analyse(const BlockMatrix& A) {
  Impl& m = *impl_;
  umfpack_di_free_symbolic(&m.symbolic);
  m.start.assign(1, 0);
  m.column.clear();
  for (int i = 0; i < A.rows(); ++i)
    for (int r = 0; r < 3; ++r) {
      for (int k = A.row_start[static_cast<size_t>(i)]; k < A.row_start[static_cast<size_t>(i) + 1]; ++k)
        for (int c = 0; c < 3; ++c) m.column.push_back(3 * A.column[static_cast<size_t>(k)] + c);
      m.start.push_back(static_cast<int>(m.column.size()));
    }
  m.value.resize(m.column.size());
  // Without values: the order depends on the pattern alone, as it will hold for other values too.
  const int status =
      umfpack_di_symbolic(m.size(), m.size(), m.start.data(), m.column.data(), nullptr, &m.symbolic, m.control, m.info);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  m.failure = status == UMFPACK_OK ? "" : "the sparsity pattern has no symbolic factorization";
}

void LuSolver::factorize(const BlockMatrix& A) {
  Impl& m = *impl_;
  m.matrix = &A;
  umfpack_di_free_numeric(&m.numeric);
  if (!m.symbolic) return;
  m.copy_values(A);
  const int status =
      umfpack_di_numeric(m.start.data(), m.column.data(), m.value.data(), m.symbolic, &m.numeric, m.control, m.info);
  m.peak = std::max(m.peak, static_cast<size_t>(m.info[UMFPACK_PEAK_MEMORY] * m.info[UMFPACK_SIZE_OF_UNIT]));
  m.failure.clear();
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::sqrt(double(m.size()));
  if (status == UMFPACK_ERROR_out_of_memory)
    m.failure = "not enough memory for the factors";
  else if (status != UMFPACK_OK || !(m.info[UMFPACK_RCOND] > rounding))
    m.failure = kSingular;  // a pivot of the scaled rows is nothing beside the largest one
}

LinearReport LuSolver::solve(const Eigen::VectorXd& b, const LinearTargets&, Eigen::VectorXd& x) {
  Impl& m = *impl_;
  LinearReport report;
  report.chosen = "lu";
  if (m.failure.empty()) {
    x.resize(b.size());
    const int status = umfpack_di_solve(UMFPACK_At, m.start.data(), m.column.data(), m.value.data(), x.data(), b.data(),
                                        m.numeric, m.control, m.info);
    if (status == UMFPACK_ERROR_out_of_memory)
      report.reason = "not enough memory for the solution";
    else
      report.ok = status == UMFPACK_OK && x.allFinite();
    if (report.ok || !report.reason.empty()) return report;
  }
  refuse(report, m.failure.empty() ? kSingular : m.failure, *m.matrix, b);
  return report;
}

std::size_t LuSolver::bytes() const {
  const Impl& m = *impl_;
  return m.peak + sizeof(int) * (m.start.size() + m.column.size()) + sizeof(double) * m.value.size();
}

}  // namespace softreel::sim
