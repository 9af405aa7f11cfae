#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/forecast_warnings.h"
#include "sim/collider_contact.h"
#include "sim/simulation.h"

namespace softreel::app {
namespace {

void warn_of_pins(const assets::Scene& scene, const MovingBody& m, std::vector<std::string>& warnings) {
  for (size_t p = 0; p < m.pin_speeds.size(); ++p) {
    const double advance = m.pin_speeds[p] * scene.time.step();
    if (m.edges.median <= 0 || advance <= m.edges.median) continue;
    warnings.push_back(fmt::format(
        "pin {} of '{}' is driven at up to {:.3g} m/s, {:.3g} m a step, farther than the mesh's edges are long ({:.3g} "
        "m): what hangs on it is torn along and may turn inside out; time.substeps = {:.0f} or a slower motion holds",
        p + 1, m.body->name, m.pin_speeds[p], advance, m.edges.median,
        std::ceil(scene.time.substeps * advance / m.edges.median)));
  }
}

void warn_of_impact(const assets::Scene& scene, const Meeting& meeting, std::vector<std::string>& warnings) {
  const double distance = scene.contact.distance, advance = meeting.speed * scene.time.step();
  const double radius = inner_radius(*meeting.collider);
  // Of an explicit method: k = c m/(h^2 d) with c = kExplicitHardness is stable up to an intrusion s = 4 d, which
  // m v^2/2 = k s^3/3 reaches at the speed v = sqrt(2 c 64/3) d/h.
  const double most = std::sqrt(2 * sim::kExplicitHardness * 64 / 3) * distance;
  const std::string who = fmt::format("'{}' may meet collider '{}' at {:.3g} m/s, {:.3g} m a step",
                                      meeting.body->body->name, meeting.collider->name, meeting.speed, advance);
  const auto substeps = [&](double allowed) { return std::ceil(scene.time.substeps * advance / allowed); };
  if (radius > 0 && advance > radius + distance)
    warnings.push_back(
        fmt::format("{}, and may come out on the other side, {:.3g} m from its middle; time.substeps = {:.0f} holds",
                    who, radius, substeps(radius + distance)));
  else if (!sim::is_implicit(scene.time.integrator) && !scene.contact.stiffness && advance > most)
    warnings.push_back(fmt::format(
        "{}; with {} the penalty takes {:.2g} m a step, and throws back what is faster with energy that it did not "
        "have; contact.distance = {:.2g} or time.substeps = {:.0f} holds",
        who, scene.time.integrator, most, distance * advance / most, substeps(most)));
}

void warn_of_friction(const assets::Scene& scene, const std::vector<Meeting>& meetings,
                      std::vector<std::string>& warnings) {
  if (sim::is_implicit(scene.time.integrator)) return;
  // Of a vertex that carries its own weight, D'' = 2 mu m g/slip_speed while it sticks: stable up to h D''/m = 2.
  for (const Meeting& meeting : meetings) {
    const double change = meeting.collider->friction * scene.gravity.norm() * scene.time.step();
    if (change <= scene.contact.slip_speed) continue;
    warnings.push_back(fmt::format(
        "friction on '{}' changes velocities by {:.2g} m/s a step, more than contact.slip_speed = {:g}: with {} what "
        "lies there trembles at about that speed; contact.slip_speed = {:.2g} or an implicit method stops it",
        meeting.collider->name, change, scene.contact.slip_speed, scene.time.integrator, change));
    return;  // the others say the same
  }
}

}  // namespace

void warn_of_speeds(const assets::Scene& scene, const std::vector<MovingBody>& bodies,
                    const std::vector<Meeting>& meetings, std::vector<std::string>& warnings) {
  for (const MovingBody& m : bodies) warn_of_pins(scene, m, warnings);
  for (const assets::Collider& c : scene.colliders) {  // of each the fastest meeting
    const Meeting* fastest = nullptr;
    for (const Meeting& m : meetings)
      if (m.collider == &c && (!fastest || m.speed > fastest->speed)) fastest = &m;
    if (fastest) warn_of_impact(scene, *fastest, warnings);
  }
  warn_of_friction(scene, meetings, warnings);
}

}  // namespace softreel::app
