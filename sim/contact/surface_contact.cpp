#include "sim/contact/surface_contact.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <tuple>

#include "sim/contact/free_path.h"
#include "sim/parallel.h"

namespace softreel::sim {
namespace {

constexpr double kNearGap = 0.1;  // of d_hat: a solve that ends nearer is taken again with more stiffness
constexpr int kHighestLevel = 10;
constexpr int kChunk = 512;  // candidates that one task looks at

double factor_of(int level) { return std::ldexp(1.0, 2 * level); }

/// Lowers `bound` to `value` if that is smaller.
void lower(std::atomic<double>& bound, double value) {
  double known = bound.load(std::memory_order_relaxed);
  while (value < known && !bound.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
  }
}

size_t chunks_of(const std::vector<Candidate>& list) { return (list.size() + kChunk - 1) / kChunk; }
size_t chunks_of(const ContactCandidates& all) { return chunks_of(all.point_triangle()) + chunks_of(all.edge_edge()); }

/// Calls look(chunk, kind, candidates) for all candidates, side by side where there are enough of them.
template <class Look>
void for_chunks(const ContactCandidates& all, const Look& look) {
  const size_t of_points = chunks_of(all.point_triangle()), chunks = chunks_of(all);
  const auto task = [&](int number) {
    const auto k = static_cast<size_t>(number);
    const bool is_point = k < of_points;
    const std::vector<Candidate>& list = is_point ? all.point_triangle() : all.edge_edge();
    const size_t first = (is_point ? k : k - of_points) * kChunk;
    look(k, is_point ? PairKind::kPointTriangle : PairKind::kEdgeEdge,
         std::span(list).subspan(first, std::min<size_t>(kChunk, list.size() - first)));
  };
  if (all.count() < 2 * kChunk)
    for (size_t k = 0; k < chunks; ++k) task(static_cast<int>(k));
  else
    parallel_tasks(static_cast<int>(chunks), task);
}

}  // namespace

SurfaceContact::SurfaceContact(std::unique_ptr<const ContactSurfaces> surfaces, const Eigen::VectorXd& masses,
                               const Eigen::VectorXd& stiffness, const SurfaceContactSettings& settings)
    : surfaces_(std::move(surfaces)), settings_(settings), candidates_(*surfaces_, settings.distance) {
  const auto n = static_cast<size_t>(surfaces_->vertices());
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (size_t v = 0; v < n; ++v) {
    const int i = surfaces_->state_vertex[v];
    mass_.push_back(i >= 0 ? masses(i) : kInfinite);
    material_.push_back(i >= 0 ? stiffness(i) : kInfinite);
  }
  base_.assign(n, settings.stiffness);
  level_.assign(n, 0);
  path_ = surfaces_->collider_path(0, 0);
  candidates_.begin(surfaces_->rest, std::vector<Vec3>(n, Vec3::Zero()));
}

PairPenalty SurfaceContact::penalty_of(PairKind kind, const Candidate& c, const std::array<int, 4>& v) const {
  PairPenalty penalty;
  penalty.reach = static_cast<double>(c.reach);
  penalty.offset = surfaces_->pairs[static_cast<size_t>(c.pair)].offset;
  const auto mean = [&](size_t first, size_t last) {
    double sum = 0;
    for (size_t i = first; i < last; ++i) sum += base_[static_cast<size_t>(v[i])];
    return sum / static_cast<double>(last - first);
  };
  const size_t cut = kind == PairKind::kPointTriangle ? 1 : 2;
  int level = 0;
  for (const int i : v) level = std::max<int>(level, level_[static_cast<size_t>(i)]);
  penalty.stiffness = std::min(mean(0, cut), mean(cut, 4)) * factor_of(level);
  if (kind == PairKind::kEdgeEdge) {
    const auto length2 = [&](size_t a, size_t b) {
      return (surfaces_->rest[static_cast<size_t>(v[a])] - surfaces_->rest[static_cast<size_t>(v[b])]).squaredNorm();
    };
    penalty.cross_rest = length2(0, 1) * length2(2, 3);
  }
  return penalty;
}

/// The pairs within reach at positions x, in the order of their features: it must not depend on what else was near.
void SurfaceContact::find_active(const std::vector<Vec3>& x, std::vector<ActivePair>& active) const {
  std::vector<std::vector<ActivePair>> found(chunks_of(candidates_));
  for_chunks(candidates_, [&](size_t k, PairKind kind, std::span<const Candidate> chunk) {
    for (const Candidate& c : chunk) {
      const std::array<int, 4> v = candidates_.vertices(kind, c);
      FourPoints at;
      for (size_t j = 0; j < 4; ++j) at[j] = x[static_cast<size_t>(v[j])];
      const double limit = static_cast<double>(c.reach) + surfaces_->pairs[static_cast<size_t>(c.pair)].offset;
      if (!(pair_distance(kind, at) < limit)) continue;
      ActivePair pair{kind, c, v, at, closest_points(kind, at), penalty_of(kind, c, v)};
      if (pair.penalty.intrusion(pair.closest.distance) > 0) found[k].push_back(pair);
    }
  });
  active.clear();
  for (const auto& part : found) active.insert(active.end(), part.begin(), part.end());
  std::sort(active.begin(), active.end(), [](const ActivePair& p, const ActivePair& q) {
    return std::tie(p.kind, p.candidate.a, p.candidate.b) < std::tie(q.kind, q.candidate.a, q.candidate.b);
  });
}

const std::vector<ActivePair>& SurfaceContact::active(const Eigen::VectorXd& x) const {
  if (active_progress_ == progress_ && x_active_.size() == x.size() && x_active_ == x) return active_;
  surfaces_->gather(x, path_, progress_, positions_);
  candidates_.cover(positions_);
  find_active(positions_, active_);
  x_active_ = x;
  active_progress_ = progress_;
  return active_;
}

void SurfaceContact::set_progress(double progress) { progress_ = progress; }

void SurfaceContact::begin_step(const StepContext& context) {
  path_ = surfaces_->collider_path(context.t, context.t_forces);
  duration_ = context.t_forces - context.t;
  colliders_move_ = false;
  for (size_t v = 0; v < path_.from.size(); ++v) colliders_move_ = colliders_move_ || path_.from[v] != path_.to[v];
  if (settings_.stiffness <= 0) {
    const double inertia = settings_.hardness / (context.h_nominal * context.h_nominal);
    for (size_t v = 0; v < base_.size(); ++v)
      base_[v] = (inertia * mass_[v] + settings_.material * material_[v]) / settings_.distance;
  }
  x_start_ = context.x;
  active_progress_ = -1;
  at_bound_ = false;
  progress_ = 0;
  surfaces_->gather(context.x, path_, 0, positions_);
  surfaces_->gather_move(context.x_predicted - context.x, path_, 1, moves_);
  candidates_.begin_step(positions_, moves_);
  touching_ = active(context.x);
  // Vertices that have come free soften, once a step.
  if (context.t != softened_at_) {
    softened_at_ = context.t;
    std::vector<std::uint8_t> touched(level_.size(), 0);
    for (const ActivePair& pair : touching_)
      for (const int v : pair.vertices) touched[static_cast<size_t>(v)] = 1;
    for (size_t v = 0; v < level_.size(); ++v)
      if (level_[v] > 0 && !touched[v] &&
          (left_out_.empty() || !left_out_[static_cast<size_t>(surfaces_->surface_of[v])]))
        --level_[v];
  }
  progress_ = 1;
}

void SurfaceContact::leave_out(std::span<const std::uint8_t> held) {
  left_out_.assign(held.empty() ? 0 : surfaces_->surfaces.size(), 1);
  for (size_t v = 0; v < surfaces_->state_vertex.size() && !left_out_.empty(); ++v) {
    const auto s = static_cast<size_t>(surfaces_->surface_of[v]);
    const int i = surfaces_->state_vertex[v];
    const bool still = i < 0 ? surfaces_->surfaces[s].motion.still()
                             : held[3 * static_cast<size_t>(i)] && held[3 * static_cast<size_t>(i) + 1] &&
                                   held[3 * static_cast<size_t>(i) + 2];
    if (!still) left_out_[s] = 0;
  }
  candidates_.leave_out(left_out_);
  active_progress_ = -1;
}

double SurfaceContact::value(const Eigen::VectorXd& x) const {
  const auto& pairs = active(x);
  return parallel_sum(static_cast<int>(pairs.size()), Work::kRow, [&](int i) {
    const ActivePair& p = pairs[static_cast<size_t>(i)];
    return pair_value(p.kind, p.x, p.closest, p.penalty);
  });
}

void SurfaceContact::add_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
  FourPoints g;
  for (const ActivePair& p : active(x)) {
    pair_gradient(p.kind, p.x, p.closest, p.penalty, g);
    for (size_t i = 0; i < 4; ++i)
      if (const int v = surfaces_->state_vertex[static_cast<size_t>(p.vertices[i])]; v >= 0)
        gradient.segment<3>(3 * v) += g[i];
  }
}

void SurfaceContact::select(const Eigen::VectorXd& x) const {
  stencils_.clear();
  for (const ActivePair& p : active(x))
    for (const int v : p.vertices) stencils_.push_back(surfaces_->state_vertex[static_cast<size_t>(v)]);
}

void SurfaceContact::element_hessians(const Eigen::VectorXd& x, double scale, Definiteness definiteness,
                                      StencilRange range, double* blocks) const {
  static_cast<void>(x);  // `select` was called there
  Eigen::Matrix<double, 12, 12> H;
  for (int e = range.first; e < range.first + range.count; ++e) {
    const ActivePair& p = active_[static_cast<size_t>(e)];
    pair_hessian(p.kind, p.x, p.closest, p.penalty, definiteness, H);
    for (int a = 0; a < 4; ++a)
      for (int b = a; b < 4; ++b, blocks += 9)
        Eigen::Map<Eigen::Matrix3d>(blocks, 3, 3) = scale * H.block<3, 3>(3 * a, 3 * b);
  }
}

void SurfaceContact::add_driven_force(const Eigen::VectorXd& x, Eigen::VectorXd& force) {
  if (!colliders_move_) return;
  Eigen::Matrix<double, 12, 12> H;
  for (const ActivePair& p : active(x)) {
    Eigen::Matrix<double, 12, 1> move;
    bool moves = false;
    for (int i = 0; i < 4; ++i) {
      move.segment<3>(3 * i) = (1 - progress_) * collider_move(p.vertices[static_cast<size_t>(i)]);
      moves = moves || !move.segment<3>(3 * i).isZero(0);
    }
    if (!moves) continue;
    pair_hessian(p.kind, p.x, p.closest, p.penalty, Definiteness::kClamped, H);
    const Eigen::Matrix<double, 12, 1> change = H * move;
    for (int i = 0; i < 4; ++i)
      if (const int v = surfaces_->state_vertex[static_cast<size_t>(p.vertices[static_cast<size_t>(i)])]; v >= 0)
        force.segment<3>(3 * v) += change.segment<3>(3 * i);
  }
}

Vec3 SurfaceContact::collider_move(int vertex) const {
  const auto v = static_cast<size_t>(vertex);
  if (surfaces_->state_vertex[v] >= 0) return Vec3::Zero();
  int before = 0;  // vertices of bodies in front of it
  for (int s = 0; s < surfaces_->surface_of[v]; ++s)
    if (!surfaces_->surfaces[static_cast<size_t>(s)].collider)
      before += surfaces_->surfaces[static_cast<size_t>(s)].count;
  const auto k = v - static_cast<size_t>(before);
  return path_.to[k] - path_.from[k];
}

/// The share of `move` that keeps every candidate apart.
double SurfaceContact::free_share(const std::vector<Vec3>& x, const std::vector<Vec3>& move) const {
  std::atomic<double> bound = 1;
  struct Shortest {
    double share = 1;
    std::array<int, 4> vertices{-1, -1, -1, -1};
  };
  std::vector<Shortest> shortest(chunks_of(candidates_));
  for_chunks(candidates_, [&](size_t k, PairKind kind, std::span<const Candidate> chunk) {
    for (const Candidate& c : chunk) {
      const std::array<int, 4> v = candidates_.vertices(kind, c);
      FourPoints at, p;
      for (size_t j = 0; j < 4; ++j) {
        at[j] = x[static_cast<size_t>(v[j])];
        p[j] = move[static_cast<size_t>(v[j])];
      }
      // An answer at or beyond the bound changes nothing, whoever set it: the minimum is the same for any threads.
      const double share = free_path(kind, at, p, surfaces_->pairs[static_cast<size_t>(c.pair)].offset,
                                     bound.load(std::memory_order_relaxed));
      if (share < shortest[k].share) {
        shortest[k] = {share, v};
        lower(bound, share);
      }
    }
  });
  double share = candidates_.lost() ? 0 : 1;
  for (const Shortest& s : shortest)
    if (s.share < share) {
      share = s.share;
      blocking_ = s.vertices;
    }
  return share;
}

double SurfaceContact::max_step(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const {
  surfaces_->gather(x, path_, progress_, positions_);
  surfaces_->gather_move(dx, path_, 1 - progress_, moves_);
  // Directions that leave the scene would make everything a candidate.
  double farthest = 0;
  for (const Vec3& move : moves_) farthest = std::max(farthest, move.norm());
  const double cut = farthest > candidates_.longest_move() ? candidates_.longest_move() / farthest : 1;
  if (!(cut > 0)) return 0;
  if (cut < 1)
    for (Vec3& move : moves_) move *= cut;
  if (candidates_.cover(positions_, moves_)) active_progress_ = -1;
  return cut * free_share(positions_, moves_);
}

bool SurfaceContact::way_is_free(const Eigen::VectorXd& from, double t_from, const Eigen::VectorXd& to,
                                 double t_to) const {
  const ContactSurfaces::ColliderPath path = surfaces_->collider_path(t_from, t_to);
  surfaces_->gather(from, path, 0, positions_);
  surfaces_->gather_move(to - from, path, 1, moves_);
  candidates_.begin(positions_, moves_);
  active_progress_ = -1;
  return free_share(positions_, moves_) >= 1;
}

bool SurfaceContact::stiffen(std::span<const int> vertices) {
  bool any = false;
  for (const int v : vertices) {
    std::uint8_t& level = level_[static_cast<size_t>(v)];
    if (level < kHighestLevel) {
      ++level;
      any = true;
    } else {
      at_bound_ = true;
    }
  }
  return any;
}

/// What the pairs of the start of the step have more in them now.
void SurfaceContact::count_stiffening(const std::vector<ActivePair>& before) {
  for (ActivePair pair : before) {
    const double was = pair_value(pair.kind, pair.x, pair.closest, pair.penalty);
    pair.penalty = penalty_of(pair.kind, pair.candidate, pair.vertices);
    stiffening_energy_ += pair_value(pair.kind, pair.x, pair.closest, pair.penalty) - was;
  }
  for (ActivePair& pair : touching_) pair.penalty = penalty_of(pair.kind, pair.candidate, pair.vertices);
  active_progress_ = -1;
}

bool SurfaceContact::stiffen_near(const Eigen::VectorXd& x) {
  std::vector<int> vertices;
  for (const ActivePair& p : active(x)) {
    if (p.gap() >= kNearGap * p.penalty.reach) continue;
    blocking_ = p.vertices;
    vertices.insert(vertices.end(), p.vertices.begin(), p.vertices.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  if (vertices.empty()) return false;
  const std::vector<ActivePair> before = touching_;
  const bool any = stiffen(vertices);
  count_stiffening(before);
  return any;
}

bool SurfaceContact::stiffen_blocking() {
  if (blocking_[0] < 0) return false;
  const std::vector<ActivePair> before = touching_;
  const bool any = stiffen(blocking_);
  count_stiffening(before);
  return any;
}

std::string SurfaceContact::blocking() const {
  if (blocking_[0] < 0) return "";
  const auto name = [&](int v) {
    return "'" + surfaces_->surfaces[static_cast<size_t>(surfaces_->surface_of[static_cast<size_t>(v)])].name + "'";
  };
  const std::string a = name(blocking_[0]), b = name(blocking_[3]);
  return a == b ? a + " and itself" : a + " and " + b;
}

SurfaceContactReport SurfaceContact::report(const Eigen::VectorXd& x) const {
  SurfaceContactReport report{candidates_.searches(), static_cast<long>(candidates_.count()), 0,
                              std::numeric_limits<double>::infinity(), 0};
  for (const ActivePair& p : active(x)) {
    ++report.active;
    report.smallest_gap = std::min(report.smallest_gap, p.gap());
    report.deepest = std::max(report.deepest, 1 - p.gap() / p.penalty.reach);
  }
  return report;
}

SlidingCount SurfaceContact::count_sliding(const Eigen::VectorXd& x, const Eigen::VectorXd& v,
                                           double slip_speed) const {
  SlidingCount count;
  for (const ActivePair& p : active(x)) {
    if (surfaces_->pairs[static_cast<size_t>(p.candidate.pair)].friction <= 0) continue;
    const Vec3 n = p.closest.r / p.closest.distance;
    Vec3 u = Vec3::Zero();
    for (size_t i = 0; i < 4; ++i) {
      const int k = surfaces_->state_vertex[static_cast<size_t>(p.vertices[i])];
      if (k >= 0)
        u += p.closest.weights[i] * v.segment<3>(3 * k);
      else if (duration_ > 0)
        u += p.closest.weights[i] / duration_ * collider_move(p.vertices[i]);
    }
    u -= n.dot(u) * n;
    ++(u.norm() < slip_speed ? count.sticks : count.slips);
  }
  return count;
}

std::vector<double> SurfaceContact::memory() const {
  std::vector<double> saved{stiffening_energy_, 0};
  for (size_t v = 0; v < level_.size(); ++v)
    if (level_[v] > 0) {
      saved.push_back(static_cast<double>(v));
      saved.push_back(level_[v]);
    }
  saved[1] = static_cast<double>(saved.size() - 2);
  return saved;
}

std::span<const double> SurfaceContact::restore(std::span<const double> saved) {
  const auto unfit = [] { throw std::invalid_argument("memory of another contact"); };
  if (saved.size() < 2 || !(saved[1] >= 0)) unfit();
  const auto count = static_cast<size_t>(saved[1]);
  if (saved.size() - 2 < count || count % 2 != 0) unfit();
  std::vector<std::uint8_t> level(level_.size(), 0);
  for (size_t k = 2; k < 2 + count; k += 2) {
    if (!(saved[k] >= 0 && saved[k] < static_cast<double>(level.size()))) unfit();
    level[static_cast<size_t>(saved[k])] = static_cast<std::uint8_t>(saved[k + 1]);
  }
  level_ = std::move(level);
  stiffening_energy_ = saved[0];
  active_progress_ = -1;
  return saved.subspan(2 + count);
}

}  // namespace softreel::sim
