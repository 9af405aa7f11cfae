#include "sim/sleep.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "sim/collider_contact.h"
#include "sim/contact/surface_contact.h"

namespace softreel::sim {
namespace {

constexpr double kCalm = 0.5;   // time at rest, after which a body falls asleep [s]
constexpr double kMoved = 10;   // times the speed: it has moved
constexpr size_t kPerBody = 4;  // numbers in the memory

/// The lowest number of the set that a belongs to.
int root(std::vector<int>& parent, int a) {
  while (parent[static_cast<size_t>(a)] != a) {
    parent[static_cast<size_t>(a)] = parent[static_cast<size_t>(parent[static_cast<size_t>(a)])];
    a = parent[static_cast<size_t>(a)];
  }
  return a;
}

void join(std::vector<int>& parent, int a, int b) {
  a = root(parent, a);
  b = root(parent, b);
  parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
}

/// A collider on its way between two times, seen from itself: what stands still goes from one place to another.
class Sweep {
 public:
  Sweep(const Collider& collider, double from, double to)
      : shape_(collider.shape), from_(collider.pose(from).inverse()), to_(collider.pose(to).inverse()) {
    turn_ = (to_.linear() - from_.linear()).norm();
  }
  /// A lower bound of its distance, on the way, from all points within `radius` of p. Distances change by no more than
  /// the way; that of points by what p does and how far they turn around it, along an arc of half a circle at most.
  double nearest(const Vec3& p, double radius) const {
    const Vec3 a = from_ * p, b = to_ * p;
    const double way = std::numbers::pi / 2 * ((b - a).norm() + turn_ * radius);
    return 0.5 * (signed_distance(shape_, a).distance + signed_distance(shape_, b).distance - way) - radius;
  }

 private:
  const ColliderShape& shape_;
  Eigen::Isometry3d from_, to_;
  double turn_;
};

}  // namespace

Sleep::Sleep(const Model& model, double speed)
    : model_(model),
      speed_(speed),
      asleep_(model.bodies.size(), 0),
      has_moved_(asleep_),
      calm_(asleep_.size(), 0),
      island_(asleep_.size(), -1) {
  for (size_t b = 0; b < model.bodies.size(); ++b)
    body_of_.insert(body_of_.end(), static_cast<size_t>(model.bodies[b].count), static_cast<int>(b));
  const std::vector<std::uint8_t> held = Pins(model).fixed();
  for (size_t b = 0; b < model.bodies.size(); ++b) {
    const auto first = held.begin() + 3 * model.bodies[b].first;
    // What is held everywhere is in no balance that could be unstable.
    has_moved_[b] = std::all_of(first, first + 3 * model.bodies[b].count, [](std::uint8_t h) { return h != 0; });
  }
  for (const auto& term : model.potentials) {
    const auto k = static_cast<size_t>(term->stencil_size());
    if (term->changing_stencils() || k < 2) continue;
    const std::span<const int> vertices = term->stencils();
    for (size_t e = 0; e + k <= vertices.size(); e += k)
      for (size_t i = 1; i < k; ++i) {
        const std::pair bodies =
            std::minmax(body_of_[static_cast<size_t>(vertices[e])], body_of_[static_cast<size_t>(vertices[e + i])]);
        if (bodies.first != bodies.second && (tied_.empty() || tied_.back() != std::pair<int, int>(bodies)))
          tied_.emplace_back(bodies);
      }
  }
}

/// Calls each(body, other) for two vertices of contact surfaces; other < 0: a collider with a motion.
template <class Each>
void Sleep::visit(int vertex, int other, const Each& each) const {
  const ContactSurfaces& surfaces = model_.surfaces->surfaces();
  const auto body = [&](int v) {
    const int i = surfaces.state_vertex[static_cast<size_t>(v)];
    return i < 0 ? -1 : body_of_[static_cast<size_t>(i)];
  };
  const auto moves = [&](int v) {
    const int surface = surfaces.surface_of[static_cast<size_t>(v)];
    return !surfaces.surfaces[static_cast<size_t>(surface)].motion.still();
  };
  const int a = body(vertex), b = body(other);
  if (a >= 0 && (b >= 0 || moves(other))) each(a, b);
  if (a < 0 && b >= 0 && moves(vertex)) each(b, -1);
}

/// For the pairs of surfaces within reach at x.
template <class Each>
void Sleep::for_touching(const Eigen::VectorXd& x, const Each& each) const {
  if (!model_.surfaces) return;
  for (const ActivePair& pair : model_.surfaces->active(x)) visit(pair.vertices[0], pair.vertices[3], each);
}

/// One that sleeps and another that does not, or a collider with a motion (b < 0).
void Sleep::wake_if_met(int a, int b) {
  for (const auto& [body, other] : {std::pair(a, b), std::pair(b, a)})
    if (body >= 0 && asleep_[static_cast<size_t>(body)] && (other < 0 || !asleep_[static_cast<size_t>(other)]))
      wake_island(island_[static_cast<size_t>(body)]);
}

void Sleep::wake_island(int island) {
  for (size_t b = 0; b < asleep_.size(); ++b) {
    if (!asleep_[b] || island_[b] != island) continue;
    asleep_[b] = 0;
    calm_[b] = 0;
    --sleeping_;
  }
}

bool Sleep::all(double t, double h) const {
  return any() && sleeping_ == static_cast<int>(asleep_.size()) &&
         !(model_.surfaces && model_.surfaces->surfaces().colliders_move(t, t + h));
}

bool Sleep::wake_near() {
  if (!any() || !model_.surfaces) return false;
  const int before = sleeping_;
  const ContactCandidates& near = model_.surfaces->candidates();
  const auto look = [&](PairKind kind, const std::vector<Candidate>& list) {
    for (const Candidate& c : list) {
      const std::array<int, 4> v = near.vertices(kind, c);
      visit(v[0], v[3], [&](int a, int b) { wake_if_met(a, b); });
    }
  };
  look(PairKind::kPointTriangle, near.point_triangle());
  look(PairKind::kEdgeEdge, near.edge_edge());
  return sleeping_ != before;
}

bool Sleep::wake_moved(const Eigen::VectorXd& x, double t, double h) {
  if (!any() || !model_.contact) return false;
  const int before = sleeping_;
  const double reach = model_.contact->distance();
  for (const Collider& collider : model_.contact->colliders()) {
    if (!collider.motion.moves(t, t + h)) continue;
    const Sweep sweep(collider, t, t + h);
    for (size_t b = 0; b < asleep_.size(); ++b) {
      if (!asleep_[b]) continue;
      const auto points =
          x.segment(3 * model_.bodies[b].first, 3 * model_.bodies[b].count).reshaped(3, model_.bodies[b].count);
      const Vec3 lower = points.rowwise().minCoeff(), upper = points.rowwise().maxCoeff();
      if (!(sweep.nearest(0.5 * (lower + upper), 0.5 * (upper - lower).norm()) < reach)) continue;
      for (Eigen::Index i = 0; i < points.cols(); ++i)
        if (sweep.nearest(points.col(i), 0) < reach) {
          wake_island(island_[b]);
          break;
        }
    }
  }
  return sleeping_ != before;
}

bool Sleep::wake_touched(const Eigen::VectorXd& x) {
  if (!any()) return false;
  const int before = sleeping_;
  for_touching(x, [&](int a, int b) { wake_if_met(a, b); });
  return sleeping_ != before;
}

bool Sleep::settle(const State& state, double h) {
  bool ready = false;
  for (size_t b = 0; b < asleep_.size(); ++b) {
    if (asleep_[b] || (!model_.restless.empty() && model_.restless[b])) continue;
    const BodyRange& body = model_.bodies[b];
    const double fastest =
        body.count == 0
            ? 0
            : state.v.segment(3 * body.first, 3 * body.count).reshaped(3, body.count).colwise().norm().maxCoeff();
    if (fastest > kMoved * speed_) has_moved_[b] = 1;
    calm_[b] = has_moved_[b] && fastest <= speed_ ? calm_[b] + h : 0;
    ready = ready || calm_[b] >= kCalm;
  }
  if (!ready) return false;
  std::vector<int> parent(asleep_.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [a, b] : tied_) join(parent, a, b);
  std::vector<int> driven;  // by a collider that moves
  for_touching(state.x, [&](int a, int b) { b >= 0 ? join(parent, a, b) : driven.push_back(a); });
  std::vector<std::uint8_t> restless(asleep_.size(), 0);  // per island
  const auto island = [&](size_t b) { return root(parent, static_cast<int>(b)); };
  for (const int b : driven) restless[static_cast<size_t>(island(static_cast<size_t>(b)))] = 1;
  for (size_t b = 0; b < asleep_.size(); ++b)
    if (!asleep_[b] && !(calm_[b] >= kCalm)) restless[static_cast<size_t>(island(b))] = 1;
  const int before = sleeping_;
  for (size_t b = 0; b < asleep_.size(); ++b) {
    if (asleep_[b] || restless[static_cast<size_t>(island(b))]) continue;
    asleep_[b] = 1;
    island_[b] = island(b);
    ++sleeping_;
  }
  return sleeping_ != before;
}

std::vector<double> Sleep::memory() const {
  std::vector<double> saved;
  for (size_t b = 0; b < asleep_.size(); ++b)
    for (const double value : {static_cast<double>(asleep_[b]), static_cast<double>(has_moved_[b]), calm_[b],
                               static_cast<double>(island_[b])})
      saved.push_back(value);
  return saved;
}

std::span<const double> Sleep::restore(std::span<const double> saved) {
  if (saved.size() < kPerBody * asleep_.size()) throw std::invalid_argument("memory of another simulation");
  sleeping_ = 0;
  for (size_t b = 0; b < asleep_.size(); ++b) {
    const std::span<const double> own = saved.subspan(kPerBody * b, kPerBody);
    asleep_[b] = own[0] != 0;
    has_moved_[b] = own[1] != 0;
    calm_[b] = own[2];
    island_[b] = static_cast<int>(own[3]);
    sleeping_ += asleep_[b];
  }
  return saved.subspan(kPerBody * asleep_.size());
}

}  // namespace softreel::sim
