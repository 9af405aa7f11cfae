#pragma once
// Moving air: its velocity, and what it does to surfaces.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// Air that moves at `velocity`, with gusts.
struct Wind {
  Vec3 velocity = Vec3::Zero();  ///< mean [m/s]
  double density = 1.2;          ///< of the air [kg/m^3] > 0
  double drag = 1.2;             ///< c of the pressure 1/2 rho c s^2 on a plate across the wind [-] >= 0
  double friction = 0;           ///< c_f of the shear stress 1/2 rho c_f u^2 along a plate, both sides [-] >= 0
  double gusts = 0;              ///< largest deviation, relative to the mean speed, along and across it [-] >= 0
  double gust_period = 3;        ///< of the slowest gusts [s] > 0
  int seed = 0;                  ///< of their phases
};

/// The velocity of the air. Gusts are a sum of a few sines whose frequencies have irrational ratios, so that nothing
/// repeats; they are carried along with the mean wind (frozen turbulence; Taylor 1938, "The spectrum of turbulence"),
/// so they run over a flag as waves.
class WindField {
 public:
  explicit WindField(const Wind& wind);

  /// At time t [s] and place p [m], [m/s].
  Vec3 velocity(double t, const Vec3& p) const;

 private:
  static constexpr size_t kSines = 4;
  Vec3 mean_;
  double amplitude_;  // [m/s]
  double slowness_;   // 1 / mean speed [s/m]; 0 without gusts
  Eigen::Matrix3d axes_;
  std::array<double, kSines> frequencies_;              // [rad/s]
  std::array<std::array<double, kSines>, 3> phases_{};  // per axis [rad]
};

/// Triangles that the wind blows on, by vertices of the state. Sheets feel it on either side; of a solid (outward
/// triangles) only what faces the wind does: its drag coefficient then is that of its shadow, as for a sheet.
struct WindSurface {
  std::vector<Triangle> triangles;
  bool closed = false;
};

/// Per triangle with area A, normal n and relative wind u = w - v (v: mean of its corners), s = u . n and u_t = u - s
/// n: force A rho/2 (c |s| s n + c_f |u_t| u_t), from the dissipation potential D(v) = A rho/6 (c |s|^3 + c_f |u_t|^3),
/// which is convex. A, n (at the predicted positions) and w (when forces are taken) are lagged.
/// `power` is what the air takes out of the motion; negative while the wind drives.
std::unique_ptr<EnergyTerm> make_wind(const Wind& wind, const std::vector<WindSurface>& surfaces);

/// D(v) = rate/2 sum m |v - w|^2: drag relative to the wind; `masses` [kg] per vertex, rate [1/s] >= 0.
std::unique_ptr<EnergyTerm> make_wind_drag(const Wind& wind, const Eigen::VectorXd& masses, double rate);

}  // namespace softreel::sim
