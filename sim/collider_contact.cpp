#include "sim/collider_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/parallel.h"

namespace softreel::sim {

ColliderContact::ColliderContact(const Eigen::VectorXd& masses, std::vector<Collider> colliders,
                                 const ContactSettings& settings)
    : masses_(masses),
      colliders_(std::move(colliders)),
      settings_(settings),
      vertices_(static_cast<size_t>(masses.size())),
      stiffness_(masses.size()),
      posed_(colliders_.size()) {
  std::iota(vertices_.begin(), vertices_.end(), 0);
  stiffness_.setConstant(settings_.stiffness);
  for (size_t c = 0; c < colliders_.size(); ++c)
    if (const auto core = core_of(colliders_[c].shape, settings.distance)) cores_.push_back({c, *core});
  place(0);
}

void ColliderContact::place(double t) {
  for (size_t c = 0; c < colliders_.size(); ++c) {
    posed_[c].world_from_shape = colliders_[c].pose(t);
    posed_[c].shape_from_world = posed_[c].world_from_shape.inverse();
  }
}

void ColliderContact::begin_step(const StepContext& context) {
  place(context.t_forces);
  if (settings_.stiffness > 0)
    stiffness_.setConstant(settings_.stiffness);
  else
    stiffness_ = settings_.hardness / (context.h_nominal * context.h_nominal * settings_.distance) * masses_;
}

/// Calls each(intrusion, world normal) for the colliders within d_hat of the point; intrusion = d_hat - d > 0.
template <class Visit>
void ColliderContact::visit(const Eigen::Vector3d& point, const Visit& each) const {
  for (size_t c = 0; c < colliders_.size(); ++c) {
    const SignedDistance d = signed_distance(colliders_[c].shape, posed_[c].shape_from_world * point);
    const double intrusion = settings_.distance - d.distance;
    if (intrusion > 0) each(intrusion, Eigen::Vector3d(posed_[c].world_from_shape.linear() * d.normal));
  }
}

double ColliderContact::value(const Eigen::VectorXd& x) const {
  return parallel_sum(static_cast<int>(vertices_.size()), Work::kRow, [&](int i) {
    double sum = 0;
    visit(x.segment<3>(3 * i), [&](double s, const Eigen::Vector3d&) { sum += stiffness_(i) / 3 * s * s * s; });
    return sum;
  });
}

void ColliderContact::add_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
  parallel_for(static_cast<int>(vertices_.size()), Work::kRow, [&](int i) {
    visit(x.segment<3>(3 * i), [&](double s, const Eigen::Vector3d& normal) {
      gradient.segment<3>(3 * i) -= stiffness_(i) * s * s * normal;
    });
  });
}

// psi' < 0 and the distance from a convex shape is convex: the curvature part is negative semi-definite on the tangent
// plane and clamped away; what stays is psi'' n n^T.
void ColliderContact::element_hessians(const Eigen::VectorXd& x, double scale, Definiteness, StencilRange range,
                                       double* blocks) const {
  for (int i = range.first; i < range.first + range.count; ++i, blocks += 9) {
    Eigen::Map<Eigen::Matrix3d> block(blocks);
    block.setZero();
    visit(x.segment<3>(3 * i), [&](double s, const Eigen::Vector3d& normal) {
      block += scale * 2 * stiffness_(i) * s * normal * normal.transpose();
    });
  }
}

/// The least share that any vertex may go; way(vertex, collider) gives its two ends in the collider's own frame.
template <class Way>
double ColliderContact::shortest(const Way& way, std::span<const std::uint8_t> held) const {
  std::vector<double> shares(vertices_.size(), 1);
  parallel_for(static_cast<int>(vertices_.size()), Work::kRow, [&](int i) {
    const auto k = static_cast<size_t>(i);
    if (held[3 * k] || held[3 * k + 1] || held[3 * k + 2]) return;
    for (const NumberedCore& c : cores_) {
      const auto [a, b] = way(i, c.collider);
      shares[k] = std::min(shares[k], free_share(c.core, a, b));
    }
  });
  const auto least = std::min_element(shares.begin(), shares.end());
  if (least == shares.end() || *least == 1) return 1;
  blocking_ = static_cast<int>(least - shares.begin());
  return *least;
}

double ColliderContact::max_step(const Eigen::VectorXd& x, const Eigen::VectorXd& dx,
                                 std::span<const std::uint8_t> held) const {
  if (!has_cores()) return 1;
  return shortest(
      [&](int i, size_t c) {
        const Eigen::Vector3d from = x.segment<3>(3 * i), move = dx.segment<3>(3 * i);
        const Eigen::Vector3d a = posed_[c].shape_from_world * from;
        return std::pair<Eigen::Vector3d, Eigen::Vector3d>(a, a + posed_[c].shape_from_world.linear() * move);
      },
      held);
}

bool ColliderContact::way_is_free(const Eigen::VectorXd& from, double t_from, const Eigen::VectorXd& to, double t_to,
                                  std::span<const std::uint8_t> held) const {
  if (!has_cores()) return true;
  std::vector<Eigen::Isometry3d> before, after;
  for (const Collider& c : colliders_) {
    before.push_back(c.pose(t_from).inverse());
    after.push_back(c.pose(t_to).inverse());
  }
  return shortest(
             [&](int i, size_t c) {
               return std::pair<Eigen::Vector3d, Eigen::Vector3d>(before[c] * from.segment<3>(3 * i),
                                                                  after[c] * to.segment<3>(3 * i));
             },
             held) == 1;
}

SignedDistance ColliderContact::at(int collider, double t, const Eigen::Vector3d& point) const {
  const Collider& c = colliders_[static_cast<size_t>(collider)];
  const Eigen::Isometry3d pose = c.pose(t);
  SignedDistance d = signed_distance(c.shape, pose.inverse() * point);
  d.normal = pose.linear() * d.normal;
  return d;
}

ContactReport ColliderContact::report(const Eigen::VectorXd& x) const {
  ContactReport report{0, std::numeric_limits<double>::infinity()};
  for (int i : vertices_)
    visit(x.segment<3>(3 * i), [&](double s, const Eigen::Vector3d&) {
      ++report.active;
      report.smallest = std::min(report.smallest, settings_.distance - s);
    });
  return report;
}

}  // namespace softreel::sim
