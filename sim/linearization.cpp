#include "sim/linearization.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collider_contact.h"
#include "sim/hessian_assembler.h"
#include "sim/lanczos.h"

namespace softreel::sim {
namespace {

using Terms = std::vector<std::unique_ptr<EnergyTerm>>;

/// The sum of the Hessians of all terms but contact at q; without terms a matrix without rows.
BlockMatrix sum_of(const Terms& terms, const Eigen::VectorXd& q, const std::vector<std::uint8_t>& held) {
  std::vector<const EnergyTerm*> list;
  std::vector<ScaledTerm> scaled;
  for (const auto& term : terms) {
    if (term->stencil_size() == 0 || term->kind() == EnergyKind::kContact) continue;
    list.push_back(term.get());
    scaled.push_back({term.get(), &q, 1.0});
  }
  BlockMatrix sum;
  if (!list.empty())
    HessianAssembler(static_cast<int>(q.size() / 3), list)
        .assemble(scaled, Eigen::VectorXd(), held, Definiteness::kExact, sum);
  return sum;
}

}  // namespace

Linearization::Linearization(const Model& model, double h, double stretch)
    : model_(model), h_(h), pins_(model), mass_(model, pins_.fixed()) {
  const Eigen::VectorXd x = stretch * model.x0;
  const StepContext context{x, model.v0, x, 0, h, h, 0, 1};
  for (const auto& term : model.potentials) term->begin_step(context);
  for (const auto& term : model.dissipations) term->begin_step(context);
  K_ = sum_of(model.potentials, x, pins_.fixed());
  C_ = sum_of(model.dissipations, model.v0, pins_.fixed());
  if (!model.contact) return;
  normals_.resize(3, model.vertices());
  for (int i = 0; i < model.vertices(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t c = 0; c < model.contact->colliders().size(); ++c) {
      const SignedDistance d = model.contact->at(static_cast<int>(c), 0, model.x0.segment<3>(3 * i));
      if (d.distance >= nearest) continue;
      nearest = d.distance;
      normals_.col(i) = d.normal;
    }
  }
  set_step(h);
}

void Linearization::set_step(double h) {
  h_ = h;
  if (!model_.contact) return;
  const StepContext context{model_.x0, model_.v0, model_.x0, 0, h, h, 0, 1};
  for (const auto& term : model_.potentials)
    if (term->kind() == EnergyKind::kContact) term->begin_step(context);
  contact_.resize(model_.vertices());
  for (int i = 0; i < model_.vertices(); ++i)
    contact_(i) = 2 * model_.contact->stiffness(i) * model_.contact->distance();
}

/// out = (K + damping C + contact) q, 0 where held.
void Linearization::multiply(const Eigen::VectorXd& q, double damping, bool touch, Eigen::VectorXd& out) const {
  if (K_.rows() > 0)
    K_.multiply(q, out);
  else
    out.setZero(q.size());
  if (damping > 0 && C_.rows() > 0) {
    C_.multiply(q, scratch_);
    out += damping * scratch_;
  }
  if (touch && contact_.size() > 0)
    for (int i = 0; i < model_.vertices(); ++i)
      out.segment<3>(3 * i) += contact_(i) * normals_.col(i).dot(q.segment<3>(3 * i)) * normals_.col(i);
  pins_.zero(out);
}

Mode Linearization::find(double damping, bool touch, const BodyRange* body) {
  const auto only = [&](Eigen::VectorXd& q) {
    if (!body) return;
    q.head(3 * body->first).setZero();
    q.tail(q.size() - 3 * (body->first + body->count)).setZero();
  };
  SymmetricPencil pencil;
  pencil.size = model_.x0.size();
  pencil.stiffness = [&](const Eigen::VectorXd& q, Eigen::VectorXd& out) {
    multiply(q, damping, touch, out);
    only(out);
  };
  pencil.mass = [&](const Eigen::VectorXd& q, Eigen::VectorXd& out) {
    out.setZero(q.size());
    mass_.add_product(q, out);
  };
  // Masses tie the vertices of one body alone: what is zero in the others stays so.
  pencil.solve_mass = [&](Eigen::VectorXd& f) {
    only(f);
    mass_.solve(f);
  };
  RitzPair pair = largest_eigenpair(pencil);
  products_ += pair.products;
  Mode mode;
  Eigen::VectorXd product(pencil.size);
  multiply(pair.vector, 0, touch, product);
  const double k = std::max(0.0, pair.vector.dot(product));
  double c = 0;
  if (C_.rows() > 0) {
    C_.multiply(pair.vector, product);
    c = std::max(0.0, pair.vector.dot(product));
  }
  // A motion that is damped but not held by anything: so slow that only the damping counts.
  mode.omega = std::max(std::sqrt(k), 1e-6 * c);
  mode.damping_ratio = mode.omega > 0 ? c / (2 * mode.omega) : 0;
  const double missed = pair.value > 0 ? pair.residual / pair.value : 0;
  mode.omega_bound = mode.omega * std::sqrt(1 + missed);
  mode.shape = std::move(pair.vector);
  return mode;
}

std::vector<Mode> Linearization::fastest(Touch touch, const BodyRange* body) {
  const bool contact = touch == Touch::kAll && has_contact();
  std::vector<Mode> modes;
  modes.push_back(find(0, contact, body));
  if (C_.rows() > 0) modes.push_back(find(2 / h_, contact, body));
  return modes;
}

ModePlace place_of(const Model& model, const Mode& mode) {
  ModePlace place;
  double most = -1;
  for (size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyRange& body = model.bodies[b];
    double energy = 0, fastest = -1;
    int vertex = body.first;
    for (int i = body.first; i < body.first + body.count; ++i) {
      const double speed = mode.shape.segment<3>(3 * i).squaredNorm();
      energy += model.masses(i) * speed;
      if (speed > fastest) {
        fastest = speed;
        vertex = i;
      }
    }
    if (energy <= most) continue;
    most = energy;
    place = {static_cast<int>(b), vertex};
  }
  return place;
}

}  // namespace softreel::sim
