#include "sim/mass.h"

#include <stdexcept>

#include "sim/hessian_assembler.h"
#include "sim/parallel.h"

namespace softreel::sim {
MassMatrix::MassMatrix(const Model& model, const std::vector<std::uint8_t>& held) : model_(model), held_(held) {}

double MassMatrix::energy(const Eigen::VectorXd& q) const {
  double sum = 0.5 * parallel_sum(model_.vertices(), Work::kVector,
                                  [&](int i) { return model_.masses(i) * q.segment<3>(3 * i).squaredNorm(); });
  for (const auto& term : model_.mass_corrections) sum += term->value(q);
  return sum;
}

void MassMatrix::add_product(const Eigen::VectorXd& q, Eigen::VectorXd& out) const {
  parallel_for(model_.vertices(), Work::kVector,
               [&](int i) { out.segment<3>(3 * i) += model_.masses(i) * q.segment<3>(3 * i); });
  for (const auto& term : model_.mass_corrections) term->add_gradient(q, out);
}

void MassMatrix::solve(Eigen::VectorXd& f) {
  parallel_for(static_cast<int>(f.size()), Work::kVector, [&](int i) {
    if (held_[static_cast<size_t>(i)]) f(i) = 0;
  });
  if (model_.mass_corrections.empty()) {
    parallel_for(model_.vertices(), Work::kVector, [&](int i) { f.segment<3>(3 * i) /= model_.masses(i); });
    return;
  }
  if (!solver_) {
    std::vector<const EnergyTerm*> terms;
    std::vector<ScaledTerm> scaled;
    for (const auto& t : model_.mass_corrections) {
      terms.push_back(t.get());
      scaled.push_back({t.get(), &model_.x0, 1.0});
    }
    HessianAssembler(model_.vertices(), terms).assemble(scaled, model_.masses, held_, Definiteness::kExact, M_);
    solver_ = make_linear_solver("cholesky");
    solver_->analyse(M_);
    solver_->factorize(M_);
  }
  scratch_ = f;
  const LinearReport report = solver_->solve(scratch_, {}, f);
  if (!report.ok) throw std::logic_error("the mass matrix cannot be factorized: " + report.reason);
}

}  // namespace softreel::sim
