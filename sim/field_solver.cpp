#include "sim/field_solver.h"

#include <Eigen/SparseCholesky>

namespace softreel::sim {

struct FieldSolver::Impl {
  const ScalarMatrix& K;
  const ScalarMatrix& M;
  std::vector<int> number;  // of a free vertex among the free ones; -1 where held
  std::vector<int> free;
  double m = 0, s = 0;
  bool analysed = false, ok = false;
  Eigen::SparseMatrix<double> A;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> llt;
  Eigen::VectorXd given, residual, right;

  void add(const ScalarMatrix& from, double factor, std::vector<Eigen::Triplet<double>>& triplets) const {
    for (int i : free)
      for (ScalarMatrix::InnerIterator entry(from, i); entry; ++entry) {
        const int row = number[static_cast<size_t>(i)], column = number[static_cast<size_t>(entry.col())];
        if (column >= 0 && column <= row) triplets.emplace_back(row, column, factor * entry.value());
      }
  }

  void factorize(double new_m, double new_s) {
    if (analysed && m == new_m && s == new_s) return;
    m = new_m;
    s = new_s;
    std::vector<Eigen::Triplet<double>> triplets;
    // Both are always in the pattern, so that the symbolic work holds for every m and s.
    add(K, s, triplets);
    add(M, m, triplets);
    const auto n = static_cast<int>(free.size());
    A.resize(n, n);
    A.setFromTriplets(triplets.begin(), triplets.end());
    if (!analysed) llt.analyzePattern(A);
    analysed = true;
    llt.factorize(A);
    ok = llt.info() == Eigen::Success;
  }
};

FieldSolver::FieldSolver(const ScalarMatrix& K, const ScalarMatrix& M, const std::vector<std::uint8_t>& held)
    : impl_(new Impl{K, M, {}, {}, 0, 0, false, false, {}, {}, {}, {}, {}}) {
  impl_->number.assign(held.size(), -1);
  for (size_t i = 0; i < held.size(); ++i)
    if (!held[i]) {
      impl_->number[i] = static_cast<int>(impl_->free.size());
      impl_->free.push_back(static_cast<int>(i));
    }
}

FieldSolver::~FieldSolver() = default;

bool FieldSolver::solve(double m, double s, const Eigen::VectorXd& b, Eigen::VectorXd& y) {
  Impl& I = *impl_;
  if (I.free.empty()) return true;
  I.factorize(m, s);
  if (!I.ok) return false;
  // What the given entries contribute goes to the right side.
  const auto n = static_cast<Eigen::Index>(I.free.size());
  I.right.resize(n);
  for (Eigen::Index r = 0; r < n; ++r) I.right(r) = b(I.free[static_cast<size_t>(r)]);
  if (n < y.size()) {
    I.given = y;
    for (int i : I.free) I.given(i) = 0;
    multiply(I.K, I.given, I.residual);
    for (Eigen::Index r = 0; r < n; ++r) I.right(r) -= s * I.residual(I.free[static_cast<size_t>(r)]);
    if (m != 0) {
      multiply(I.M, I.given, I.residual);
      for (Eigen::Index r = 0; r < n; ++r) I.right(r) -= m * I.residual(I.free[static_cast<size_t>(r)]);
    }
  }
  const Eigen::VectorXd solution = I.llt.solve(I.right);
  for (Eigen::Index r = 0; r < n; ++r) y(I.free[static_cast<size_t>(r)]) = solution(r);
  return solution.allFinite();
}

}  // namespace softreel::sim
