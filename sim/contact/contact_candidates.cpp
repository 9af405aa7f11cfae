#include "sim/contact/contact_candidates.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

// Room around a move, so that the next ones, which are mostly shorter, stay in it: of d_hat, and of the move.
constexpr double kRoom = 1, kRoomOfMove = 0.1;
// A tree whose boxes have grown by so much is built anew.
constexpr double kWorn = 2.0;

}  // namespace

ContactCandidates::ContactCandidates(const ContactSurfaces& surfaces, double reach)
    : surfaces_(surfaces), reach_(reach), trees_(surfaces.surfaces.size()), built_cost_(trees_.size(), 0) {
  for (const ContactSurface& surface : surfaces.surfaces) {
    Eigen::AlignedBox3d box;
    for (int v = surface.first; v < surface.first + surface.count; ++v)
      box.extend(surfaces.rest[static_cast<size_t>(v)]);
    if (!box.isEmpty()) extent_ = std::max(extent_, box.diagonal().norm());
  }
  for (const SurfacePair& pair : surfaces.pairs)
    for (const int s : {pair.a, pair.b}) {
      auto& tree = trees_[static_cast<size_t>(s)];
      const ContactSurface& surface = surfaces.surfaces[static_cast<size_t>(s)];
      if (tree) continue;
      tree = std::make_unique<BoxTree>(
          std::span(surfaces.triangles)
              .subspan(static_cast<size_t>(surface.first_triangle), static_cast<size_t>(surface.triangle_count)),
          surfaces.rest);
    }
}

std::array<int, 4> ContactCandidates::vertices(PairKind kind, const Candidate& c) const {
  if (kind == PairKind::kPointTriangle) {
    const Triangle& t = surfaces_.triangles[static_cast<size_t>(c.b)];
    return {c.a, t[0], t[1], t[2]};
  }
  const auto &e = surfaces_.edges[static_cast<size_t>(c.a)], &f = surfaces_.edges[static_cast<size_t>(c.b)];
  return {e[0], e[1], f[0], f[1]};
}

ContactCandidates::Place ContactCandidates::place_of(const std::vector<Vec3>& x) const {
  Place place;
  if (move2_ > 0) {
    const double along = parallel_sum(static_cast<int>(x.size()), Work::kVector, [&](int i) {
      const auto v = static_cast<size_t>(i);
      return (x[v] - start_[v]).dot(move_[v]);
    });
    place.s = std::clamp(along / move2_, 0.0, 1.0);
  }
  for (const ContactSurface& surface : surfaces_.surfaces) {
    Vec3 sum = Vec3::Zero();
    for (int i = surface.first; i < surface.first + surface.count; ++i) {
      const auto v = static_cast<size_t>(i);
      sum += x[v] - start_[v] - place.s * move_[v];
    }
    place.shift.push_back(surface.count > 0 ? Vec3(sum / surface.count) : sum);
  }
  return place;
}

double ContactCandidates::off(const std::vector<Vec3>& x, const Place& place, size_t v) const {
  return (x[v] - start_[v] - place.s * move_[v] - place.shift[static_cast<size_t>(surfaces_.surface_of[v])]).norm();
}

double ContactCandidates::apart(const Place& place, const SurfacePair& pair) const {
  return (place.shift[static_cast<size_t>(pair.b)] - place.shift[static_cast<size_t>(pair.a)]).norm();
}

void ContactCandidates::leave_out(std::vector<std::uint8_t> surfaces) {
  left_out_ = std::move(surfaces);
  stale_ = true;
}

/// The rigid motion that takes most of a surface's moves away: its mean, and the turn w of least squares. Any other
/// would be as safe.
void ContactCandidates::fit_rigid_move(const ContactSurface& surface) {
  Vec3 middle = Vec3::Zero(), mean = Vec3::Zero(), spin = Vec3::Zero();
  const auto each = [&](const auto& visit) {
    for (int v = surface.first; v < surface.first + surface.count; ++v)
      visit(start_[static_cast<size_t>(v)], move_[static_cast<size_t>(v)]);
  };
  each([&](const Vec3& x, const Vec3& m) {
    middle += x;
    mean += m;
  });
  if (surface.count > 0) {
    middle /= surface.count;
    mean /= surface.count;
  }
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  double widest = 0;
  each([&](const Vec3& x, const Vec3& m) {
    const Vec3 arm = x - middle;
    spin += arm.cross(m - mean);
    inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    widest = std::max(widest, arm.norm());
  });
  Vec3 turn = inertia.ldlt().solve(spin);
  // A turn that gains less than d_hat is not worth boxes of its own.
  if (!turn.allFinite() || !(turn.norm() * widest > reach_)) turn.setZero();
  middle_.push_back(middle);
  mean_move_.push_back(mean);
  turn_.push_back(turn);
}

/// What a vertex moves beside its surface's rigid motion.
Vec3 ContactCandidates::own_move(size_t v) const {
  const auto s = static_cast<size_t>(surfaces_.surface_of[v]);
  return move_[v] - mean_move_[s] - turn_[s].cross(start_[v] - middle_[s]);
}

void ContactCandidates::begin(const std::vector<Vec3>& x, const std::vector<Vec3>& move) {
  start_ = x;
  move_ = move;
  move2_ = 0;
  for (const Vec3& m : move) move2_ += m.squaredNorm();
  mean_move_.clear();
  middle_.clear();
  turn_.clear();
  radius_.resize(x.size());
  for (const ContactSurface& surface : surfaces_.surfaces) {
    fit_rigid_move(surface);
    for (int v = surface.first; v < surface.first + surface.count; ++v)
      radius_[static_cast<size_t>(v)] = kRoom * reach_ + kRoomOfMove * own_move(static_cast<size_t>(v)).norm();
  }
  shift_.clear();
  for (const SurfacePair& pair : surfaces_.pairs)
    shift_.push_back(kRoom * reach_ +
                     kRoomOfMove *
                         (mean_move_[static_cast<size_t>(pair.b)] - mean_move_[static_cast<size_t>(pair.a)]).norm());
  small_ = true;
  for (const std::vector<double>* rooms : {&radius_, &shift_})
    for (const double room : *rooms) small_ = small_ && room <= (kRoom + kRoomOfMove) * reach_;
  search();
}

bool ContactCandidates::holds(const std::vector<Vec3>& x, const Place& place) const {
  for (size_t p = 0; p < surfaces_.pairs.size(); ++p)
    if (!(apart(place, surfaces_.pairs[p]) <= shift_[p])) return false;
  for (size_t v = 0; v < x.size(); ++v)
    if (!(off(x, place, v) <= radius_[v])) return false;
  return true;
}

bool ContactCandidates::cover(const std::vector<Vec3>& x) {
  if (!stale_ && holds(x, place_of(x))) return false;
  begin(x, std::vector<Vec3>(x.size(), Vec3::Zero()));
  return true;
}

bool ContactCandidates::covers(const std::vector<Vec3>& x, const std::vector<Vec3>& move) const {
  if (stale_ || !holds(x, place_of(x))) return false;
  std::vector<Vec3> end(x.size());
  for (size_t v = 0; v < x.size(); ++v) end[v] = x[v] + move[v];
  return holds(end, place_of(end));
}

bool ContactCandidates::cover(const std::vector<Vec3>& x, const std::vector<Vec3>& move) {
  if (covers(x, move)) return false;
  begin(x, move);
  return true;
}

void ContactCandidates::begin_step(const std::vector<Vec3>& x, const std::vector<Vec3>& move) {
  if (count() > 0 || lost_ || !small_ || !covers(x, move)) begin(x, move);
}

/// Boxes of everything that vertices may come to, in frames that move with their surfaces; for pairs of one surface
/// also in frames that turn with it.
///
/// Of a surface with the turn w, W = [w]x, the vertex x goes to x + s (m + W (x - c) + r), r its own move. In the
/// coordinates y = (1 + s W)^-1 (x(s) - c - s m) it goes from x - c by s (1 + s W)^-1 r, which is off the straight way
/// s r by at most |w| |r|. W is antisymmetric, so 1 + s W makes no vector shorter: what is apart in y is as far apart
/// in x.
void ContactCandidates::refit(bool turning) {
  vertex_box_.resize(start_.size());
  parallel_for(static_cast<int>(start_.size()), Work::kRow, [&](int i) {
    const auto v = static_cast<size_t>(i), s = static_cast<size_t>(surfaces_.surface_of[v]);
    const Vec3 move = turning ? own_move(v) : Vec3(move_[v] - mean_move_[s]);
    const double bent = turning ? turn_[s].norm() * move.norm() : 0;
    Box3f box;
    box.add(start_[v]);
    box.add(Vec3(start_[v] + move));
    // Two boxes, each larger by half of the distance at which their features begin to feel each other.
    box.grow(bent + radius_[v] + 0.5 * reach_ + surfaces_.surfaces[s].half_thickness);
    vertex_box_[v] = box;
  });
  triangle_box_.resize(surfaces_.triangles.size());
  parallel_for(static_cast<int>(triangle_box_.size()), Work::kRow, [&](int i) {
    const auto t = static_cast<size_t>(i);
    triangle_box_[t] = {};
    for (const int v : surfaces_.triangles[t]) triangle_box_[t].add(vertex_box_[static_cast<size_t>(v)]);
  });
  edge_box_.resize(surfaces_.edges.size());
  parallel_for(static_cast<int>(edge_box_.size()), Work::kRow, [&](int i) {
    const auto e = static_cast<size_t>(i);
    edge_box_[e] = {};
    for (const int v : surfaces_.edges[e]) edge_box_[e].add(vertex_box_[static_cast<size_t>(v)]);
  });
  parallel_tasks(static_cast<int>(trees_.size()), [&](int i) {
    const auto s = static_cast<size_t>(i);
    if (!trees_[s]) return;
    trees_[s]->refit(vertex_box_);
    if (built_cost_[s] == 0) {
      built_cost_[s] = trees_[s]->cost();
    } else if (trees_[s]->cost() > kWorn * built_cost_[s]) {
      const ContactSurface& surface = surfaces_.surfaces[s];
      std::vector<Vec3> middles;
      for (const Box3f& box : vertex_box_)
        middles.push_back((0.5F * (box.lower + box.upper)).head<3>().matrix().cast<double>());
      trees_[s] = std::make_unique<BoxTree>(
          std::span(surfaces_.triangles)
              .subspan(static_cast<size_t>(surface.first_triangle), static_cast<size_t>(surface.triangle_count)),
          middles);
      trees_[s]->refit(vertex_box_);
      built_cost_[s] = trees_[s]->cost();
    }
  });
}

void ContactCandidates::search() {
  ++searches_;
  stale_ = false;
  point_triangle_.clear();
  edge_edge_.clear();
  lost_ = false;
  for (size_t v = 0; v < start_.size(); ++v) {
    const Vec3& mean = mean_move_[static_cast<size_t>(surfaces_.surface_of[v])];
    lost_ = lost_ || !((move_[v] - mean).norm() + radius_[v] <= 2 * kFarthest * extent_);
  }
  if (lost_) return;
  const bool own =
      std::any_of(surfaces_.pairs.begin(), surfaces_.pairs.end(), [](const auto& p) { return p.a == p.b; });
  const bool others =
      std::any_of(surfaces_.pairs.begin(), surfaces_.pairs.end(), [](const auto& p) { return p.a != p.b; });
  const bool turning = own && std::any_of(turn_.begin(), turn_.end(), [](const Vec3& w) { return !w.isZero(0); });
  if (own) {
    refit(turning);
    search_pairs(true);
  }
  if (others) {
    if (!own || turning) refit(false);
    search_pairs(false);
  }
}

/// Among pairs of a surface with itself, or of two; with the boxes as they are.
void ContactCandidates::search_pairs(bool own) {
  struct Part {
    BoxTree::Work work;
    size_t pair;
    Box3f shifts;
  };
  std::vector<Part> parts;
  for (size_t p = 0; p < surfaces_.pairs.size(); ++p) {
    const SurfacePair& pair = surfaces_.pairs[p];
    if ((pair.a == pair.b) != own) continue;
    if (!left_out_.empty() && left_out_[static_cast<size_t>(pair.a)] && left_out_[static_cast<size_t>(pair.b)])
      continue;
    const BoxTree& tree = *trees_[static_cast<size_t>(pair.a)];
    if (pair.a == pair.b) {
      for (const BoxTree::Work& w : tree.self_work()) parts.push_back({w, p, {}});
      continue;
    }
    // A rule may set surfaces farther apart than their own thicknesses do.
    Box3f shifts;
    shifts.add(Vec3(Vec3::Zero()));
    shifts.add(Vec3(mean_move_[static_cast<size_t>(pair.b)] - mean_move_[static_cast<size_t>(pair.a)]));
    const double thickness = surfaces_.surfaces[static_cast<size_t>(pair.a)].half_thickness +
                             surfaces_.surfaces[static_cast<size_t>(pair.b)].half_thickness;
    shifts.grow(shift_[p] + std::max(0.0, pair.offset - thickness));
    for (const BoxTree::Work& w : tree.work_with(*trees_[static_cast<size_t>(pair.b)], shifts))
      parts.push_back({w, p, shifts});
  }
  std::vector<std::vector<Candidate>> points(parts.size()), edges(parts.size());
  parallel_tasks(static_cast<int>(parts.size()), [&](int i) {
    const auto k = static_cast<size_t>(i);
    const Part& part = parts[k];
    const SurfacePair& pair = surfaces_.pairs[part.pair];
    const ContactSurface &a = surfaces_.surfaces[static_cast<size_t>(pair.a)],
                         &b = surfaces_.surfaces[static_cast<size_t>(pair.b)];
    const auto boxes = [&](const ContactSurface& s) {
      return std::span<const Box3f>(triangle_box_)
          .subspan(static_cast<size_t>(s.first_triangle), static_cast<size_t>(s.triangle_count));
    };
    std::vector<BoxTree::Pair> found;
    const bool self = pair.a == pair.b;
    const BoxTree& tree = *trees_[static_cast<size_t>(pair.a)];
    if (self)
      tree.self_pairs(part.work, boxes(a), found);
    else
      tree.pairs_with(part.work, *trees_[static_cast<size_t>(pair.b)], part.shifts, boxes(a), boxes(b), found);
    for (BoxTree::Pair t : found) {
      t.first += a.first_triangle;
      t.second += b.first_triangle;
      add_features(t, pair, static_cast<int>(part.pair), self ? nullptr : &part.shifts, points[k], edges[k]);
    }
  });
  for (size_t k = 0; k < parts.size(); ++k) {
    point_triangle_.insert(point_triangle_.end(), points[k].begin(), points[k].end());
    edge_edge_.insert(edge_edge_.end(), edges[k].begin(), edges[k].end());
  }
}

}  // namespace softreel::sim
