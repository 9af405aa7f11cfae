#pragma once
// Puts a model together, body by body; what is not asked for is not built.
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/attachment.h"
#include "sim/collider_contact.h"
#include "sim/contact/contact_surfaces.h"
#include "sim/load.h"
#include "sim/mesh.h"
#include "sim/model.h"
#include "sim/springs.h"
#include "sim/wind.h"

namespace softreel::sim {

struct SolidMaterial {
  std::string model = "stable-neo-hookean";
  double young = 1e5;     ///< [Pa] > 0
  double poisson = 0.4;   ///< in (-1, 0.5)
  double density = 1000;  ///< [kg/m^3] > 0
  bool consistent_mass = false;
};

enum class BendingModel { kAuto, kQuadratic, kDiscreteShell };  ///< kAuto: quadratic where flat at rest

struct MembraneMaterial {
  std::string model = "stvk";
  double young = 1e5;       ///< [Pa] > 0
  double poisson = 0.3;     ///< in (-1, 0.5)
  double thickness = 1e-3;  ///< [m] > 0
  double bending = 0;       ///< flexural rigidity [N m] >= 0; 0 leaves bending out
  BendingModel bending_model = BendingModel::kAuto;
  double areal_density = 1;  ///< [kg/m^2] > 0
  bool consistent_mass = false;
};

struct Damping {
  double drag = 0;   ///< against the velocity relative to the wind [1/s] >= 0
  double alpha = 0;  ///< Rayleigh, mass [1/s] >= 0
  double beta = 0;   ///< Rayleigh, stiffness [s] >= 0
};

/// Bodies are added where they are at rest (world coordinates, [m]); each call returns the body's range.
class ModelBuilder {
 public:
  BodyRange add_solid(const std::string& name, const TetMesh& rest, const SolidMaterial& material);
  BodyRange add_membrane(const std::string& name, const TriangleMesh& rest, const MembraneMaterial& material);
  /// `springs`: vertex indices of `rest`; `spring_damping` [N s/m].
  BodyRange add_mass_spring(const std::string& name, const TriangleMesh& rest, std::vector<Spring> springs,
                            double areal_density, double spring_damping);
  /// Points with masses [kg] > 0; `springs`: indices of `points`; `spring_damping` [N s/m].
  BodyRange add_points(const std::string& name, const std::vector<Vec3>& points, const std::vector<double>& masses,
                       std::vector<Spring> springs, double spring_damping);

  /// v += velocity + spin x (x - centre of mass); velocity [m/s], spin [rad/s].
  void set_velocity(const BodyRange& body, const Vec3& velocity, const Vec3& spin);
  void add_pin(Pin pin);
  void add_load(NodalForces forces, const LoadTimes& times);
  /// `damping` of each tie [N s/m] >= 0.
  void add_ties(const std::vector<Tie>& ties, double damping);
  /// Wind on `surfaces`; [damping] drag is relative to it.
  void set_wind(const Wind& wind, std::vector<WindSurface> surfaces);

  /// Surfaces that touch each other, in the places where bodies were added; [contact] comes with `finish`.
  void set_surfaces(std::vector<SurfaceInput> surfaces, std::vector<SurfacePairRule> rules) {
    surfaces_ = std::move(surfaces);
    surface_rules_ = std::move(rules);
  }

  /// Of the bodies added so far: masses, n [kg], positions, 3n [m], and how stiff they are (stiffness_scale), n [N/m].
  Eigen::VectorXd masses() const;
  Eigen::VectorXd positions() const;
  Eigen::VectorXd stiffness() const;

  /// Adds gravity [m/s^2], damping and contact, as far as they are not zero or empty. The builder is empty afterwards.
  Model finish(const Vec3& gravity, const Damping& damping, std::vector<Collider> colliders,
               const ContactSettings& contact);

 private:
  BodyRange add_body(const std::string& name, const std::vector<Vec3>& rest, const std::vector<double>& masses);

  void keep_awake(std::span<const int> vertices);

  template <class Mesh>
  void add_mass_correction(const Mesh& rest, double density, const BodyRange& body);

  Model model_;
  std::vector<std::function<std::unique_ptr<EnergyTerm>(double)>> scaled_corrections_;
  std::vector<double> masses_;
  std::vector<double> x_, v_;
  std::vector<std::unique_ptr<EnergyTerm>> loads_;
  std::optional<Wind> wind_;
  std::vector<WindSurface> wind_surfaces_;
  std::vector<SurfaceInput> surfaces_;
  std::vector<SurfacePairRule> surface_rules_;
};

}  // namespace softreel::sim
