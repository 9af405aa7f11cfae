#include "sim/field.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "sim/field_solver.h"
#include "sim/integrators.h"
#include "sim/integrators/implicit_euler.h"
#include "sim/integrators/runge_kutta.h"
#include "sim/mesh_topology.h"
#include "sim/method_table.h"
#include "sim/parallel.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

enum class Kind { kPoisson, kHeat, kWave };

struct Entry {
  MethodInfo info;
  Kind kind;
};

constexpr std::array kEquations = {
    Entry{{"poisson", "-Laplace u = source: what is at rest under a load; elliptic", "one solve for each new load",
           "Strang, Fix 1973, chapter 1"},
          Kind::kPoisson},
    Entry{{"heat", "u_t = diffusivity Laplace u + source: evens out; parabolic", "one product or solve a step",
           "Crank, Nicolson 1947; Strang, Fix 1973, chapter 7"},
          Kind::kHeat},
    Entry{{"wave", "u_tt = speed^2 Laplace u + source: travels; hyperbolic", "one product or solve a step",
           "Hughes 1987, chapter 9"},
          Kind::kWave},
};

Kind kind_of(std::string_view equation) { return find_method(kEquations, equation, "equation").kind; }

/// y' = f(t, y) by one of the Runge-Kutta methods of bodies.
using Derivative = std::function<void(double t, Eigen::VectorXd& y, Eigen::VectorXd& dy)>;

template <const auto& kTableau>
void step_by(const Derivative& f, double t, double h, Eigen::VectorXd& y) {
  std::array<Eigen::VectorXd, kTableau.b.size()> k;
  runge_kutta_step(kTableau, f, t, h, y, k);
}

struct FirstOrderMethod {
  MethodInfo info;
  void (*step)(const Derivative&, double, double, Eigen::VectorXd&);  // null: implicit Euler
};

constexpr std::array kFirstOrderMethods = {
    FirstOrderMethod{ImplicitEuler::kInfo, nullptr},
    FirstOrderMethod{ForwardEuler::kInfo, step_by<kForwardEulerTableau>},
    FirstOrderMethod{Heun::kInfo, step_by<kHeunTableau>},
    FirstOrderMethod{Midpoint::kInfo, step_by<kMidpointTableau>},
    FirstOrderMethod{Rk4::kInfo, step_by<kRk4Tableau>},
};

Eigen::VectorXd sampled(const TriangleMesh& mesh, const FieldFunction& f, double t) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i) values(static_cast<Eigen::Index>(i)) = f(mesh.vertices[i], t);
  return values;
}

/// Entries between -1 and 1 without a pattern that a mesh could share, the same in every run.
Eigen::VectorXd scattered(Eigen::Index n) {
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) x(i) = 2 * std::fmod(static_cast<double>(i + 1) * 0.6180339887498949, 1.0) - 1;
  return x;
}

/// Throws if some connected piece of the mesh has no held vertex.
void require_held_everywhere(const ScalarMatrix& K, const std::vector<std::uint8_t>& held) {
  std::vector<bool> reached(held.size(), false);
  std::vector<int> stack;
  for (size_t i = 0; i < held.size(); ++i)
    if (held[i]) {
      reached[i] = true;
      stack.push_back(static_cast<int>(i));
    }
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    for (ScalarMatrix::InnerIterator entry(K, i); entry; ++entry) {
      const auto j = static_cast<size_t>(entry.col());
      if (reached[j]) continue;
      reached[j] = true;
      stack.push_back(static_cast<int>(j));
    }
  }
  for (size_t i = 0; i < reached.size(); ++i)
    if (!reached[i])
      throw std::invalid_argument(
          "poisson needs a fixed value on every connected piece of the mesh: without one (pure Neumann conditions) the "
          "solution is free up to a constant, and there is none at all unless the source sums to zero; the piece with "
          "vertex " +
          std::to_string(i) + " has none");
}

}  // namespace

Catalogue field_equations() { return catalogue_of<kEquations>(); }

Catalogue field_integrators(std::string_view equation) {
  switch (kind_of(equation)) {
    case Kind::kWave: {
      static const std::vector<MethodInfo> moving = [] {
        std::vector<MethodInfo> infos;
        for (const MethodInfo& info : integrators())
          if (info.name != "static") infos.push_back(info);
        return infos;
      }();
      return moving;
    }
    case Kind::kHeat:
      return catalogue_of<kFirstOrderMethods>();
    case Kind::kPoisson:
      break;
  }
  return {};
}

struct Field::Impl {
  FieldProblem problem;
  Kind kind;
  double factor = 1;  // of K: 1, k or c^2
  ScalarMatrix K, M;
  Eigen::VectorXd lumped;  // the diagonal of M, if it is lumped
  std::vector<std::uint8_t> held;
  std::vector<int> held_vertices;  // each once
  std::vector<size_t> held_by;     // which of problem.fixed gives its value
  Eigen::VectorXd held_values;     // as of held_time
  double held_time = -1;
  bool held_vary = false;
  Eigen::VectorXd load;
  double load_time = -1;
  State state;                                    // x = u, v = u_t (empty but for a wave)
  Integrator method;                              // of a wave
  const FirstOrderMethod* first_order = nullptr;  // of heat
  std::unique_ptr<FieldSolver> solver;            // of steps, or of poisson
  std::unique_ptr<FieldSolver> mass_solver;       // of a consistent M alone
  Stage stage;
  Eigen::VectorXd product;  // scratch

  Impl(FieldProblem p, std::string_view integrator) : problem(std::move(p)), kind(kind_of(problem.equation)) {
    if (kind == Kind::kHeat) factor = problem.diffusivity;
    if (kind == Kind::kWave) factor = problem.speed * problem.speed;
    if (!(factor > 0)) throw std::invalid_argument("diffusivity and speed have to be above 0");
    K = assemble_stiffness(problem.mesh);
    M = assemble_mass(problem.mesh, problem.mass);
    if (problem.mass == FieldMass::kLumped) lumped = M.diagonal();
    collect_held();
    if (kind == Kind::kPoisson) {
      require_held_everywhere(K, held);
    } else {
      choose(integrator);
      state.x = sampled(problem.mesh, problem.initial, 0);
    }
    if (kind == Kind::kWave) {
      state.v = sampled(problem.mesh, problem.initial_rate, 0);
      for (int i : held_vertices) state.v(i) = 0;
    }
    if (kind == Kind::kPoisson) state.x = Eigen::VectorXd::Zero(K.rows());
    place(0, state.x);
    if (kind == Kind::kPoisson && !solve_poisson(state)) throw std::invalid_argument(kSingular);
  }

  static constexpr const char* kSingular = "the matrix of the field is not positive definite";

  void choose(std::string_view integrator) {
    bool known = false;
    std::string names;
    for (const MethodInfo& info : field_integrators(problem.equation)) {
      known = known || info.name == integrator;
      names += (names.empty() ? "" : ", ") + std::string(info.name);
    }
    if (!known)
      throw std::invalid_argument(problem.equation + " cannot be stepped with '" + std::string(integrator) +
                                  "'; it takes " + names);
    if (kind == Kind::kHeat)
      first_order = &find_method(kFirstOrderMethods, integrator, "integrator");
    else
      method = make_integrator(integrator);
  }

  // --- boundary conditions -------------------------------------------------------------------------------------------

  void collect_held() {
    const size_t n = problem.mesh.vertices.size();
    held.assign(n, 0);
    std::vector<size_t> by(n, 0);
    for (size_t f = 0; f < problem.fixed.size(); ++f)
      for (int v : problem.fixed[f].vertices) {
        if (v < 0 || static_cast<size_t>(v) >= n) throw std::invalid_argument("a fixed value names no vertex");
        held[static_cast<size_t>(v)] = 1;
        by[static_cast<size_t>(v)] = f;
      }
    for (size_t i = 0; i < n; ++i)
      if (held[i]) {
        held_vertices.push_back(static_cast<int>(i));
        held_by.push_back(by[i]);
        held_vary = held_vary || problem.fixed[by[i]].value.varies;
      }
    if (held_vary && problem.mass == FieldMass::kConsistent && kind != Kind::kPoisson)
      throw std::invalid_argument(
          "fixed values that vary in time need lumped mass: consistent mass would couple to their time derivatives");
  }

  /// Puts the fixed values of time t into u.
  void place(double t, Eigen::VectorXd& u) {
    if (held_vertices.empty()) return;
    if (held_time < 0 || (held_vary && t != held_time)) {
      held_values.resize(static_cast<Eigen::Index>(held_vertices.size()));
      for (size_t k = 0; k < held_vertices.size(); ++k)
        held_values(static_cast<Eigen::Index>(k)) =
            problem.fixed[held_by[k]].value(problem.mesh.vertices[static_cast<size_t>(held_vertices[k])], t);
      held_time = t;
    }
    for (size_t k = 0; k < held_vertices.size(); ++k) u(held_vertices[k]) = held_values(static_cast<Eigen::Index>(k));
  }

  const Eigen::VectorXd& load_at(double t) {
    if (load_time < 0 || (problem.source.varies && t != load_time)) {
      assemble_load(problem.mesh, problem.source, t, load);
      load_time = t;
    }
    return load;
  }

  // --- solve ---------------------------------------------------------------------------------------------------------

  bool solve_poisson(State& s) { return step_solver().solve(0, 1, load_at(s.t), s.x); }

  /// r <- M^-1 r at the free vertices, 0 at the held ones.
  void divide_by_mass(Eigen::VectorXd& r) {
    if (lumped.size() > 0) {
      parallel_for(static_cast<int>(r.size()), Work::kVector, [&](int i) { r(i) /= lumped(i); });
    } else {
      if (!mass_solver) mass_solver = std::make_unique<FieldSolver>(K, M, held);
      const Eigen::VectorXd b = r;
      r.setZero();
      mass_solver->solve(1, 0, b, r);
    }
    for (int i : held_vertices) r(i) = 0;
  }

  /// a = M^-1 (F(t) - factor K u): u_t of heat, u_tt of a wave. Puts what is held where it belongs at t.
  void derivative(double t, Eigen::VectorXd& u, Eigen::VectorXd& a) {
    if (held_vary) place(t, u);
    multiply(K, u, a);
    const Eigen::VectorXd& F = load_at(t);
    parallel_for(static_cast<int>(a.size()), Work::kVector, [&](int i) { a(i) = F(i) - factor * a(i); });
    divide_by_mass(a);
  }

  FieldSolver& step_solver() {
    if (!solver) solver = std::make_unique<FieldSolver>(K, M, held);
    return *solver;
  }

  bool heat_step(double h) {
    const double t = state.t;
    if (first_order->step) {
      first_order->step([this](double at, Eigen::VectorXd& u, Eigen::VectorXd& du) { derivative(at, u, du); }, t, h,
                        state.x);
      return true;
    }
    // (M + h k K) u' = M u + h F
    multiply(M, state.x, product);
    product += h * load_at(t + h);
    place(t + h, state.x);
    return step_solver().solve(1, h * factor, product, state.x);
  }

  bool wave_step(double h) {
    const Acceleration acceleration{[this](State& at, Eigen::VectorXd& a) { derivative(at.t, at.x, a); }, false};
    if (method.explicit_method) {
      method.explicit_method->step(acceleration, h, state);
      return true;
    }
    ImplicitMethod& implicit = *method.implicit_method;
    const double fraction = implicit.fraction(), end = state.t + h;
    implicit.predict(state, h, acceleration, stage);
    // The least of 1/2 |y - y_tilde|_M^2 + beta (c^2/2 y^T K y - F.y): (M + beta c^2 K) y = M y_tilde + beta F.
    multiply(M, stage.y_tilde, product);
    product += stage.beta * load_at(state.t + fraction * h);
    // What is held goes from where it is to where it belongs at the end; y lies in between.
    Eigen::VectorXd y = state.x;
    place(end, y);
    y = state.x + fraction * (y - state.x);
    if (!step_solver().solve(1, stage.beta * factor, product, y)) return false;
    implicit.finish(y, h, state);
    return true;
  }

  void forget() {
    if (method.implicit_method) method.implicit_method->forget();
    if (method.explicit_method) method.explicit_method->forget();
  }
};

Field::Field(FieldProblem problem, std::string_view integrator)
    : impl_(std::make_unique<Impl>(std::move(problem), integrator)) {}
Field::~Field() = default;
Field::Field(Field&&) noexcept = default;

const FieldProblem& Field::problem() const { return impl_->problem; }
double Field::time() const { return impl_->state.t; }
const Eigen::VectorXd& Field::value() const { return impl_->state.x; }
const Eigen::VectorXd& Field::rate() const { return impl_->state.v; }
const ScalarMatrix& Field::stiffness() const { return impl_->K; }
const ScalarMatrix& Field::mass() const { return impl_->M; }

FieldEnergies Field::energies() const {
  if (impl_->kind != Kind::kWave) return {};
  Eigen::VectorXd product;
  FieldEnergies energies;
  multiply(impl_->M, impl_->state.v, product);
  energies.kinetic = 0.5 * impl_->state.v.dot(product);
  multiply(impl_->K, impl_->state.x, product);
  energies.potential = 0.5 * impl_->factor * impl_->state.x.dot(product);
  return energies;
}

StepReport Field::step(double h) {
  Impl& I = *impl_;
  StepReport report;
  report.steps = 1;
  const Stopwatch watch(report.seconds.total);
  const double end = I.state.t + h;
  if (I.kind == Kind::kPoisson) {
    const bool varies = I.held_vary || I.problem.source.varies;
    I.state.t = end;
    if (!varies) return report;
    I.place(end, I.state.x);
    if (!I.solve_poisson(I.state)) {
      report.converged = false;
      report.reason = Impl::kSingular;
    }
    return report;
  }
  const State before = I.state;
  const bool ok = I.kind == Kind::kHeat ? I.heat_step(h) : I.wave_step(h);
  I.state.t = end;
  I.place(end, I.state.x);
  if (I.kind == Kind::kWave && I.held_vary)
    for (int i : I.held_vertices) I.state.v(i) = (I.state.x(i) - before.x(i)) / h;
  if (ok && I.state.x.allFinite() && I.state.v.allFinite()) return report;
  report.converged = false;
  report.steps = 0;
  report.reason = ok ? "the values ran away" : Impl::kSingular;
  I.state = before;
  I.forget();
  return report;
}

std::vector<double> Field::memory() const {
  const Integrator& method = impl_->method;
  if (method.implicit_method) return method.implicit_method->memory();
  if (method.explicit_method) return method.explicit_method->memory();
  return {};
}

void Field::restore(double t, const Eigen::VectorXd& value, const Eigen::VectorXd& rate,
                    std::span<const double> memory) {
  State& s = impl_->state;
  if (value.size() != s.x.size() || rate.size() != s.v.size()) throw std::invalid_argument("values of another field");
  Integrator& method = impl_->method;
  if (method.implicit_method) method.implicit_method->restore(memory);
  if (method.explicit_method) method.explicit_method->restore(memory);
  s = {t, value, rate};
}

double Field::largest_eigenvalue() const {
  Impl& I = *impl_;
  Eigen::VectorXd x = scattered(I.K.rows()), Kx;
  for (int i : I.held_vertices) x(i) = 0;
  double eigenvalue = 0;
  constexpr int kMost = 300;
  for (int k = 0; k < kMost && x.squaredNorm() > 0; ++k) {
    Eigen::VectorXd Mx;
    multiply(I.K, x, Kx);
    multiply(I.M, x, Mx);
    const double next = x.dot(Kx) / x.dot(Mx);
    const bool settled = std::abs(next - eigenvalue) <= 1e-5 * next;
    eigenvalue = next;
    if (settled && k >= 20) break;
    I.divide_by_mass(Kx);
    x = Kx / Kx.norm();
  }
  return 1.05 * I.factor * eigenvalue;
}

}  // namespace softreel::sim
