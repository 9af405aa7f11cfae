#include "sim/attachment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "sim/element_term.h"
#include "sim/nearest_point.h"
#include "sim/spring_damping.h"
#include "sim/springs.h"

namespace softreel::sim {
namespace {

/// r = sum c_a x_a with c = (1, -w): a vertex and K - 1 corners.
template <int K>
using Coefficients = Eigen::Matrix<double, K, 1>;

template <int K>
Coefficients<K> coefficients(const Tie& tie) {
  Coefficients<K> c;
  c(0) = 1;
  for (int j = 1; j < K; ++j) c(j) = -tie.weights(j - 1);
  return c;
}

/// out += (c c^T) (x) block
template <int K>
void add_spread(const Coefficients<K>& c, const Eigen::Matrix3d& block, ElementHessian<K>& out) {
  for (int a = 0; a < K; ++a)
    for (int b = 0; b < K; ++b) out.template block<3, 3>(3 * a, 3 * b) += c(a) * c(b) * block;
}

template <int K>
struct TouchKernel {
  static constexpr int kCorners = K;
  static constexpr bool kConstantHessian = true;
  std::vector<Coefficients<K>> c;
  std::vector<double> stiffness;  // [N/m], or [N s/m] as damping

  Vec3 gap(int e, const Corners<K>& X) const { return X * c[static_cast<size_t>(e)]; }
  double energy(int e, const Corners<K>& X) const {
    return 0.5 * stiffness[static_cast<size_t>(e)] * gap(e, X).squaredNorm();
  }
  void gradient(int e, const Corners<K>& X, Corners<K>& out) const {
    out = stiffness[static_cast<size_t>(e)] * gap(e, X) * c[static_cast<size_t>(e)].transpose();
  }
  void hessian(int e, const Corners<K>&, Definiteness, ElementHessian<K>& out) const {
    out.setZero();
    add_spread<K>(c[static_cast<size_t>(e)], stiffness[static_cast<size_t>(e)] * Eigen::Matrix3d::Identity(), out);
  }
};

/// A rod of length L between the vertex and a weighted point of the triangle.
struct Rod {
  Coefficients<4> c;
  double stiffness, length;

  double energy(const Corners<4>& X) const {
    const double stretch = (X * c).norm() - length;
    return 0.5 * stiffness * stretch * stretch;
  }
  void add_gradient(const Corners<4>& X, Corners<4>& out) const {
    const Vec3 d = X * c;
    const double now = d.norm();
    if (now > 0) out += stiffness * (now - length) / now * d * c.transpose();
  }
  void add_hessian(const Corners<4>& X, Definiteness definiteness, ElementHessian<4>& out) const {
    const Vec3 d = X * c;
    const double now = d.norm();
    if (!(now > 0)) return add_spread<4>(c, stiffness * Eigen::Matrix3d::Identity(), out);
    double across = 1 - length / now;  // negative under compression
    if (definiteness == Definiteness::kClamped) across = std::max(across, 0.0);
    const Eigen::Matrix3d along = d * d.transpose() / (now * now);
    add_spread<4>(c, stiffness * (along + across * (Eigen::Matrix3d::Identity() - along)), out);
  }
};

struct BridgeKernel {
  static constexpr int kCorners = 4;
  static constexpr bool kConstantHessian = false;
  std::vector<std::array<Rod, 4>> rods;

  double energy(int e, const Corners<4>& X) const {
    double sum = 0;
    for (const Rod& rod : rods[static_cast<size_t>(e)]) sum += rod.energy(X);
    return sum;
  }
  void gradient(int e, const Corners<4>& X, Corners<4>& out) const {
    out.setZero();
    for (const Rod& rod : rods[static_cast<size_t>(e)]) rod.add_gradient(X, out);
  }
  // A sum of clamped rods is semi-definite, but may be more than the sum clamped: the exact one is kept where it is
  // convex.
  void hessian(int e, const Corners<4>& X, Definiteness definiteness, ElementHessian<4>& out) const {
    out.setZero();
    for (const Rod& rod : rods[static_cast<size_t>(e)]) rod.add_hessian(X, Definiteness::kExact, out);
    if (definiteness == Definiteness::kClamped) clamp_to_semidefinite<12>(out);
  }
};

struct BridgeDampingKernel {
  static constexpr int kCorners = 4;
  static constexpr bool kConstantHessian = false;
  double damping;  // [N s/m]
  std::vector<Coefficients<4>> c;
  std::vector<Vec3> direction;

  void begin_step(const StepContext& context, std::span<const int> stencils) {
    for (size_t e = 0; e < c.size(); ++e) {
      Vec3 d = Vec3::Zero();
      for (size_t a = 0; a < 4; ++a)
        d += c[e](static_cast<Eigen::Index>(a)) * context.x_predicted.segment<3>(3 * stencils[4 * e + a]);
      const double length = d.norm();
      direction[e] = length > 0 ? Vec3(d / length) : Vec3::Zero();
    }
  }
  double rate(int e, const Corners<4>& V) const {
    return direction[static_cast<size_t>(e)].dot(V * c[static_cast<size_t>(e)]);
  }
  double energy(int e, const Corners<4>& V) const { return 0.5 * damping * rate(e, V) * rate(e, V); }
  void gradient(int e, const Corners<4>& V, Corners<4>& out) const {
    out = damping * rate(e, V) * direction[static_cast<size_t>(e)] * c[static_cast<size_t>(e)].transpose();
  }
  void hessian(int e, const Corners<4>&, Definiteness, ElementHessian<4>& out) const {
    const Vec3& d = direction[static_cast<size_t>(e)];
    out.setZero();
    add_spread<4>(c[static_cast<size_t>(e)], damping * d * d.transpose(), out);
  }
};

std::vector<int> stencils_of(const std::vector<const Tie*>& ties, int k) {
  std::vector<int> stencils;
  for (const Tie* t : ties) {
    stencils.push_back(t->vertex);
    stencils.insert(stencils.end(), t->corners.begin(), t->corners.begin() + (k - 1));
  }
  return stencils;
}

template <int K>
std::unique_ptr<EnergyTerm> touch_term(std::string_view name, EnergyKind kind, const std::vector<const Tie*>& ties,
                                       const double* damping) {
  TouchKernel<K> kernel;
  for (const Tie* t : ties) {
    kernel.c.push_back(coefficients<K>(*t));
    kernel.stiffness.push_back(damping ? *damping : t->stiffness);
  }
  return std::make_unique<ElementTerm<TouchKernel<K>>>(name, kind, stencils_of(ties, K), std::move(kernel));
}

std::array<Rod, 4> rods_of(const Tie& tie) {
  std::array<Rod, 4> rods;
  rods[0] = {coefficients<4>(tie), tie.stiffness, tie.length};
  for (int j = 0; j < 3; ++j) {
    Coefficients<4> c = Coefficients<4>::Unit(0);
    c(j + 1) = -1;
    rods[static_cast<size_t>(j) + 1] = {c, 2.0 / 3.0 * tie.stiffness, tie.to_corners(j)};
  }
  return rods;
}

/// Ties by what they need.
struct Kinds {
  std::vector<const Tie*> touch_point, touch_surface, bridge_point, bridge_surface;
  explicit Kinds(const std::vector<Tie>& ties) {
    for (const Tie& t : ties) {
      auto& touching = t.to_surface() ? touch_surface : touch_point;
      auto& apart = t.to_surface() ? bridge_surface : bridge_point;
      (t.length > 0 ? apart : touching).push_back(&t);
    }
  }
};

std::vector<Spring> as_springs(const std::vector<const Tie*>& ties) {
  std::vector<Spring> springs;
  for (const Tie* t : ties) springs.push_back({t->vertex, t->corners[0], t->stiffness, t->length});
  return springs;
}

Tie tie_to_surface(const Vec3& p, const TiedBody& b, const NearestPoint& nearest, bool snap) {
  Tie tie;
  const Triangle& t = b.surface[static_cast<size_t>(nearest.triangle)];
  double longest = 0;
  for (size_t j = 0; j < 3; ++j) {
    const Vec3& corner = (*b.rest)[static_cast<size_t>(t[j])];
    tie.corners[j] = b.first + t[j];
    tie.to_corners(static_cast<Eigen::Index>(j)) = (p - corner).norm();
    longest = std::max(longest, (corner - (*b.rest)[static_cast<size_t>(t[(j + 1) % 3])]).norm());
  }
  tie.weights = nearest.weights;
  constexpr double kTouching = 1e-3;
  if (!snap && nearest.distance > kTouching * longest) tie.length = nearest.distance;
  return tie;
}

Tie tie_to_point(const Vec3& p, const TiedBody& b, double extent, double& distance, bool snap) {
  Tie tie;
  distance = std::numeric_limits<double>::infinity();
  for (size_t j = 0; j < b.rest->size(); ++j) {
    const double d = (p - (*b.rest)[j]).norm();
    if (d >= distance) continue;
    distance = d;
    tie.corners.fill(b.first + static_cast<int>(j));
  }
  constexpr double kTouching = 1e-6;
  if (!snap && distance > kTouching * extent) tie.length = distance;
  return tie;
}

}  // namespace

std::vector<std::unique_ptr<EnergyTerm>> make_ties(const std::vector<Tie>& ties) {
  const Kinds kinds(ties);
  std::vector<std::unique_ptr<EnergyTerm>> terms;
  const auto add = [&](auto term) { terms.push_back(std::move(term)); };
  if (!kinds.touch_point.empty()) add(touch_term<2>("ties", EnergyKind::kElastic, kinds.touch_point, nullptr));
  if (!kinds.touch_surface.empty()) add(touch_term<4>("ties", EnergyKind::kElastic, kinds.touch_surface, nullptr));
  if (!kinds.bridge_point.empty()) add(make_springs(as_springs(kinds.bridge_point)));
  if (!kinds.bridge_surface.empty()) {
    BridgeKernel kernel;
    for (const Tie* t : kinds.bridge_surface) kernel.rods.push_back(rods_of(*t));
    add(std::make_unique<ElementTerm<BridgeKernel>>("ties", EnergyKind::kElastic, stencils_of(kinds.bridge_surface, 4),
                                                    std::move(kernel)));
  }
  return terms;
}

std::vector<std::unique_ptr<EnergyTerm>> make_tie_damping(const std::vector<Tie>& ties, double damping) {
  const Kinds kinds(ties);
  std::vector<std::unique_ptr<EnergyTerm>> terms;
  const auto add = [&](auto term) { terms.push_back(std::move(term)); };
  constexpr EnergyKind kKind = EnergyKind::kDissipation;
  if (!kinds.touch_point.empty()) add(touch_term<2>("tie damping", kKind, kinds.touch_point, &damping));
  if (!kinds.touch_surface.empty()) add(touch_term<4>("tie damping", kKind, kinds.touch_surface, &damping));
  if (!kinds.bridge_point.empty()) add(make_spring_damping(as_springs(kinds.bridge_point), damping));
  if (!kinds.bridge_surface.empty()) {
    BridgeDampingKernel kernel{damping, {}, {}};
    for (const Tie* t : kinds.bridge_surface) kernel.c.push_back(coefficients<4>(*t));
    kernel.direction.assign(kernel.c.size(), Vec3::Zero());
    add(std::make_unique<ElementTerm<BridgeDampingKernel>>("tie damping", kKind, stencils_of(kinds.bridge_surface, 4),
                                                           std::move(kernel)));
  }
  return terms;
}

std::vector<Tie> find_ties(const TiedBody& a, std::span<const int> vertices, const TiedBody& b,
                           const AttachSettings& settings, const Eigen::VectorXd& scale) {
  const NearestPointTree tree(*b.rest, b.surface);
  double extent = 0;
  for (const Vec3& q : *b.rest) extent = std::max(extent, (q - b.rest->front()).norm());
  std::vector<Tie> ties;
  for (int v : vertices) {
    const Vec3& p = (*a.rest)[static_cast<size_t>(v)];
    double distance = 0;
    Tie tie;
    if (b.surface.empty()) {
      tie = tie_to_point(p, b, extent, distance, settings.snap);
    } else {
      const NearestPoint nearest = tree.find(p);
      distance = nearest.distance;
      tie = tie_to_surface(p, b, nearest, settings.snap);
    }
    if (!(distance <= settings.near)) continue;
    tie.vertex = a.first + v;
    tie.stiffness = settings.stiffness;
    if (tie.stiffness <= 0) {
      double there = 0;
      for (size_t j = 0; j < 3; ++j) there += tie.weights(static_cast<Eigen::Index>(j)) * scale(tie.corners[j]);
      const double here = scale(tie.vertex);
      const double softer = here > 0 && there > 0 ? std::min(here, there) : std::max(here, there);
      if (!(softer > 0)) throw std::invalid_argument("both ends are free points: a tie between them needs a stiffness");
      tie.stiffness = 10 * softer;
    }
    ties.push_back(tie);
  }
  return ties;
}

}  // namespace softreel::sim
