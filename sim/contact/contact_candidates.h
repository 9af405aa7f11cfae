#pragma once
// Broad phase: which pairs of features may come near each other on the moves of a step.
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/contact/box_tree.h"
#include "sim/contact/closest_points.h"
#include "sim/contact/contact_surfaces.h"

namespace softreel::sim {

/// Two features whose boxes meet. 16 bytes.
struct Candidate {
  int a = 0;        ///< a vertex, or an edge
  int b = 0;        ///< a triangle, or an edge; a < b if both are edges of one surface
  float reach = 0;  ///< d_hat of this pair: smaller where it is close at rest [m]
  int pair = 0;     ///< of surfaces
};

/// Complete for a set of places: all vertices go from where they are along a move, together: x + s m, s in [0, 1].
/// Beside that every surface may be shifted as a whole, and every vertex may be off by its own radius. As long as
/// positions are of this kind, no pair that comes within reach is missing; and the set is convex: a straight way
/// between two places in it stays in it. `cover` looks for pairs anew where a move would leave it. What is far apart
/// costs a box test; what moves along with its neighbours is no candidate for that, at any speed.
class ContactCandidates {
 public:
  /// `reach`: d_hat [m] > 0. `surfaces` must outlive this.
  ContactCandidates(const ContactSurfaces& surfaces, double reach);

  /// Looks for pairs around the straight way from `x` to x + `move` (one vector per vertex).
  void begin(const std::vector<Vec3>& x, const std::vector<Vec3>& move);
  /// The same, but no pairs may stand for what was looked for in an earlier step, if they are complete for this way as
  /// well: what is far apart stays cheap. It changes `count` alone: no pair there comes nearer than `reach`, and none
  /// by more than a few times that, so it bounds no step. A run that is taken up again need not know of it.
  void begin_step(const std::vector<Vec3>& x, const std::vector<Vec3>& move);
  /// Makes the candidates complete for such a way. True if they had to be looked for again.
  bool cover(const std::vector<Vec3>& x, const std::vector<Vec3>& move);

  /// From now on, pairs of surfaces that both have a flag are left out; empty: none is.
  void leave_out(std::vector<std::uint8_t> surfaces);

  const std::vector<Candidate>& point_triangle() const { return point_triangle_; }
  const std::vector<Candidate>& edge_edge() const { return edge_edge_; }
  std::size_t count() const { return point_triangle_.size() + edge_edge_.size(); }

  /// The four vertices of a candidate.
  std::array<int, 4> vertices(PairKind kind, const Candidate& c) const;

  /// The same for positions that nothing has led to by a straight way.
  bool cover(const std::vector<Vec3>& x);

  /// True if a surface has been torn so far from its shape that there is no sense in looking for pairs; there are none.
  bool lost() const { return lost_; }
  /// Of one vertex in one move, for which pairs are looked for [m].
  double longest_move() const { return kFarthest * extent_; }

  long searches() const { return searches_; }  ///< since the start

 private:
  /// How positions lie in the set: their s, and the shift of each surface.
  struct Place {
    double s = 0;
    std::vector<Vec3> shift;
  };
  void fit_rigid_move(const ContactSurface& surface);
  Vec3 own_move(size_t vertex) const;
  Place place_of(const std::vector<Vec3>& x) const;
  double off(const std::vector<Vec3>& x, const Place& place, size_t vertex) const;
  double apart(const Place& place, const SurfacePair& pair) const;
  bool covers(const std::vector<Vec3>& x, const std::vector<Vec3>& move) const;
  bool holds(const std::vector<Vec3>& x, const Place& place) const;
  void search();
  void refit(bool turning);
  void search_pairs(bool own);
  bool may_meet(PairKind kind, const SurfacePair& pair, int pair_number, const Candidate& c) const;
  void add_features(const BoxTree::Pair& triangles, const SurfacePair& pair, int pair_number, const Box3f* shifts,
                    std::vector<Candidate>& points, std::vector<Candidate>& edges) const;
  bool is_candidate(PairKind kind, const SurfacePair& pair, int pair_number, Candidate& c) const;
  bool close_reach(PairKind kind, const SurfacePair& pair, Candidate& c) const;

  const ContactSurfaces& surfaces_;
  double reach_;
  std::vector<std::unique_ptr<BoxTree>> trees_;  // per surface that can touch
  std::vector<double> built_cost_;               // of each tree, when it was first fitted
  std::vector<Vec3> start_, move_;               // per vertex [m]
  double move2_ = 0;                             // sum of squares of the moves
  std::vector<Vec3> mean_move_, middle_, turn_;  // per surface: its rigid motion [m], about [m], [rad]
  std::vector<double> radius_;                   // per vertex: how far off it may be [m]
  std::vector<double> shift_;                    // per pair of surfaces: how far apart their shifts may be [m]
  std::vector<Box3f> vertex_box_, edge_box_, triangle_box_;
  std::vector<Candidate> point_triangle_, edge_edge_;
  // Of the extent of the largest surface: beyond it everything would be near everything.
  static constexpr double kFarthest = 4;
  double extent_ = 0;   // [m]
  bool small_ = false;  // the room around moves is a few times the reach at most
  bool lost_ = false;
  bool stale_ = false;  // `leave_out` came after the last search
  std::vector<std::uint8_t> left_out_;
  long searches_ = 0;
};

}  // namespace softreel::sim
