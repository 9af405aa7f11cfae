#include "sim/convergence_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/method_table.h"
#include "sim/parallel.h"

namespace softreel::sim {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

struct Entry {
  MethodInfo info;
  StoppingTest test;
};
constexpr std::array kTests = {
    Entry{{"residual", "forces of every body down to tolerance times those at the start", "1 gradient an iteration",
           "Nocedal, Wright 2006, section 3.1"},
          StoppingTest::kResidual},
    Entry{{"decrement", "Newton decrement down to tolerance times the first", "none beside Newton's step",
           "Boyd, Vandenberghe 2004, section 9.5"},
          StoppingTest::kDecrement},
    Entry{{"step", "last full step of every body below tolerance times its way in the solve", "none",
           "Dennis, Schnabel 1996, section 7.2"},
          StoppingTest::kStep},
};

}  // namespace

Catalogue stopping_tests() { return catalogue_of<kTests>(); }

ConvergenceTest::ConvergenceTest(const Model& model, const IncrementalPotential& phi, const MinimizerSettings& settings)
    : model_(model),
      phi_(phi),
      test_(find_method(kTests, settings.stop, "stopping test").test),
      tolerance_(settings.tolerance) {}

std::vector<double> ConvergenceTest::body_norms(const Eigen::VectorXd& g) const {
  std::vector<double> norms;
  norms.reserve(model_.bodies.size());
  for (const BodyRange& b : model_.bodies) {
    const double squared = parallel_sum(3 * b.count, Work::kVector, [&](int i) {
      const double v = g(3 * b.first + i);
      return v * v;
    });
    norms.push_back(std::sqrt(squared));
  }
  return norms;
}

void ConvergenceTest::start(const Eigen::VectorXd& y, const Eigen::VectorXd& g) {
  fired_ = {};
  first_decrement_ = 0;
  g0_ = norms_ = body_norms(g);
  if (test_ == StoppingTest::kStep) y0_ = y;
  const Stage& stage = phi_.stage();
  diagonal_ = stage.inertia * model_.masses + stage.beta * phi_.stiffness();
  set_floors(y);
}

void ConvergenceTest::see_hessian(const BlockMatrix& H, const Eigen::VectorXd& y) {
  const Stage& stage = phi_.stage();
  diagonal_ = stage.inertia * model_.masses + stage.beta * phi_.stiffness();
  for (int i = 0; i < H.rows(); ++i)
    diagonal_(i) = std::max(diagonal_(i), H.block(H.diagonal[static_cast<size_t>(i)]).diagonal().maxCoeff());
  set_floors(y);
}

void ConvergenceTest::set_floors(const Eigen::VectorXd& y) {
  floors_.clear();
  targets_.clear();
  value_rounding_ = 0;
  for (size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyRange& body = model_.bodies[b];
    const double squared = parallel_sum(body.count, Work::kVector, [&](int k) {
      const int i = body.first + k;
      const double floor = diagonal_(i) * y.segment<3>(3 * i).norm();
      return floor * floor;
    });
    value_rounding_ += kRounding * parallel_sum(body.count, Work::kVector, [&](int k) {
                         const int i = body.first + k;
                         return diagonal_(i) * y.segment<3>(3 * i).squaredNorm();
                       });
    floors_.push_back(kRounding * std::sqrt(squared));
    targets_.push_back(std::max(tolerance_ * g0_[b], floors_[b]));
  }
}

std::string ConvergenceTest::look(const Eigen::VectorXd& g) {
  norms_ = body_norms(g);
  bool at_rest = true, met = true;
  residual_ = 0;
  for (size_t b = 0; b < norms_.size(); ++b) {
    if (!std::isfinite(norms_[b])) return "forces on '" + model_.bodies[b].name + "' are not finite";
    at_rest = at_rest && norms_[b] <= floors_[b];
    met = met && norms_[b] <= targets_[b];
    // Where the floor at rounding decides, there are no forces to compare with.
    if (targets_[b] > floors_[b]) residual_ = std::max(residual_, norms_[b] / g0_[b]);
  }
  if (!fired_.empty()) return {};  // by the last direction or step
  if (at_rest)
    fired_ = "rounding";
  else if (met && test_ == StoppingTest::kResidual)
    fired_ = "residual";
  return {};
}

void ConvergenceTest::look_at_slope(double slope) {
  if (test_ != StoppingTest::kDecrement) return;
  const double decrement = std::sqrt(std::max(0.0, -slope));
  if (first_decrement_ == 0) first_decrement_ = decrement;
  if (decrement < first_decrement_ && decrement <= tolerance_ * first_decrement_) fired_ = "decrement";
}

void ConvergenceTest::look_at_step(const Eigen::VectorXd& y, const Eigen::VectorXd& d, bool full) {
  if (test_ != StoppingTest::kStep || !full) return;
  const std::vector<double> steps = body_norms(d), ways = body_norms(y - y0_), sizes = body_norms(y);
  for (size_t b = 0; b < steps.size(); ++b)
    if (!(steps[b] <= std::max(tolerance_ * ways[b], kRounding * sizes[b]))) return;
  fired_ = "step";
}

const std::string& ConvergenceTest::slowest() const {
  size_t worst = 0;
  for (size_t b = 1; b < norms_.size(); ++b)
    if (norms_[b] * targets_[worst] > norms_[worst] * targets_[b]) worst = b;
  return model_.bodies[worst].name;
}

}  // namespace softreel::sim
