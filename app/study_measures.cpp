#include "app/study_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/momentum_watch.h"
#include "app/world.h"
#include "sim/collider.h"

namespace softreel::app {
namespace {

using Eigen::Vector3d;

double total(const sim::Energies& e) { return e.kinetic + e.elastic + e.gravity + e.contact + e.dissipated; }

bool driven(const std::vector<assets::Pin>& pins) {
  return std::any_of(pins.begin(), pins.end(), [](const assets::Pin& p) { return !p.motion.empty(); });
}

template <class Is>
bool any_body(const assets::Scene& s, const Is& is) {
  return std::any_of(s.soft.begin(), s.soft.end(), is) || std::any_of(s.cloth.begin(), s.cloth.end(), is) ||
         std::any_of(s.springs.begin(), s.springs.end(), is);
}

/// Work from outside is in no account: scripted motions, loads that change, and equilibria, which have no motion.
bool keeps_energy(const assets::Scene& s) {
  if (s.time.integrator == "static" || any_body(s, [](const assets::Body& b) { return driven(b.pins); })) return false;
  if (std::any_of(s.colliders.begin(), s.colliders.end(), [](const auto& c) { return !c.motion.empty(); }))
    return false;
  return std::all_of(s.loads.begin(), s.loads.end(),
                     [](const assets::Load& l) { return l.from == 0 && l.ramp == 0 && !l.until; });
}

struct Momenta {
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
  double speed = 0;  // RMS by mass [m/s]
};

Momenta momenta(const sim::Model& model, const sim::State& s) {
  Momenta m;
  double mass = 0;
  Vector3d centre = Vector3d::Zero();
  for (int i = 0; i < model.vertices(); ++i) {
    const Vector3d v = s.v.segment<3>(3 * i);
    m.linear += model.masses(i) * v;
    m.speed += model.masses(i) * v.squaredNorm();
    centre += model.masses(i) * s.x.segment<3>(3 * i);
    mass += model.masses(i);
  }
  centre /= mass;
  m.speed = std::sqrt(m.speed / mass);
  for (int i = 0; i < model.vertices(); ++i)
    m.angular += model.masses(i) * (Vector3d(s.x.segment<3>(3 * i)) - centre).cross(Vector3d(s.v.segment<3>(3 * i)));
  return m;
}

void momentum_drifts(const assets::Scene& scene, const sim::Model& model, const Trial& trial, double size, Drifts& d) {
  const double mass = model.masses.sum();
  const Momenta first = momenta(model, trial.frames.front().state);
  double linear = 0, angular = 0, speed = 0;
  for (const CachedFrame& frame : trial.frames) {
    const Momenta m = momenta(model, frame.state);
    linear = std::max(linear, (m.linear - first.linear - mass * frame.state.t * scene.gravity).norm());
    angular = std::max(angular, (m.angular - first.angular).norm());
    speed = std::max(speed, m.speed);
  }
  if (!(speed > 0)) return;
  d.momentum = linear / (mass * speed);
  d.angular = angular / (mass * speed * size);
}

double volume_change(const Shapes& shapes, const Trial& trial) {
  double largest = 0;
  int first = 0;
  for (const SolidShape& shape : shapes.soft) {
    double rest = 0;
    const auto volume = [&](const auto& at) {
      double sum = 0;
      for (const sim::Tet& t : shape.rest.tets) sum += sim::tet_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3]));
      return sum;
    };
    rest = volume([&](int v) { return shape.rest.vertices[static_cast<size_t>(v)]; });
    for (const CachedFrame& frame : trial.frames) {
      const double now = volume([&](int v) { return Vector3d(frame.state.x.segment<3>(3 * (first + v))); });
      largest = std::max(largest, std::abs(now / rest - 1));
    }
    first += static_cast<int>(shape.rest.vertices.size());
  }
  return largest;
}

double penetration(const assets::Scene& scene, const Trial& trial) {
  double deepest = 0;
  for (const assets::Collider& description : scene.colliders) {
    const sim::Collider collider = make_collider(description);
    for (const CachedFrame& frame : trial.frames) {
      const Eigen::Isometry3d shape_from_world = collider.pose(frame.state.t).inverse();
      for (Eigen::Index i = 0; i < frame.state.x.size(); i += 3)
        deepest = std::max(
            deepest,
            -sim::signed_distance(collider.shape, shape_from_world * Vector3d(frame.state.x.segment<3>(i))).distance);
    }
  }
  return deepest;
}

double pin_violation(const sim::Model& model, const Trial& trial) {
  const sim::Pins pins(model);
  double farthest = 0;
  for (const CachedFrame& frame : trial.frames) {
    Eigen::VectorXd x = frame.state.x;
    pins.place(frame.state.t, x);
    farthest = std::max(farthest, (x - frame.state.x).cwiseAbs().maxCoeff());
  }
  return farthest;
}

}  // namespace

PositionErrors position_errors(const std::vector<Eigen::Matrix3Xd>& actual,
                               const std::vector<Eigen::Matrix3Xd>& expected, const StudyView* view) {
  PositionErrors e;
  double clip = 0;
  for (size_t f = 0; f < actual.size(); ++f) {
    const Eigen::ArrayXd squares = (actual[f] - expected[f]).colwise().squaredNorm().array();
    e.end = std::sqrt(squares.mean());
    clip += squares.mean();
    e.worst = std::max(e.worst, e.end);
    e.largest = std::max(e.largest, std::sqrt(squares.maxCoeff()));
    if (!view) continue;
    double sum = 0;
    for (Eigen::Index i = 0; i < actual[f].cols(); ++i) {
      const double px = view->apart(actual[f].col(i), expected[f].col(i));
      sum += px * px;
      e.largest_px = std::max(e.largest_px, px);
    }
    e.end_px = std::sqrt(sum / static_cast<double>(actual[f].cols()));
  }
  e.clip = std::sqrt(clip / static_cast<double>(actual.size()));
  return e;
}

Drifts drifts(const assets::Scene& scene, const Shapes& shapes, const Trial& trial, double size) {
  Drifts d;
  const sim::Model model = build_model(scene, shapes);
  if (keeps_energy(scene)) {
    double kinetic = 0, change = 0;
    for (const CachedFrame& frame : trial.frames) kinetic = std::max(kinetic, frame.figures.energies.kinetic);
    for (const double e : energy_changes(trial)) change = std::max(change, std::abs(e));
    if (kinetic > 0) d.energy = change / kinetic;
  }
  if (keeps_momentum(scene)) momentum_drifts(scene, model, trial, size, d);
  if (!shapes.soft.empty()) d.volume = volume_change(shapes, trial);
  if (!scene.colliders.empty()) d.penetration = penetration(scene, trial);
  if (!model.pins.empty()) d.pins = pin_violation(model, trial);
  return d;
}

std::vector<double> energy_changes(const Trial& trial) {
  std::vector<double> changes;
  for (const CachedFrame& frame : trial.frames)
    changes.push_back(total(frame.figures.energies) - total(trial.frames.front().figures.energies));
  return changes;
}

}  // namespace softreel::app
