#pragma once
// What a scene file says, as plain data: every key with its default. `read_scene` (scene_reader.h) fills it and checks
// it; whoever receives a Scene from there may rely on every range and rule written in scene_keys.cpp.
//
// SI units, y up, angles in degrees, colours as they are written (sRGB, 0 to 1).
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh.h"

namespace softreel::assets {

using Vec3 = sim::Vec3;

/// sRGB as written in the file, each 0 to 1; not linear light.
struct Color {
  double r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};

enum class ClothModel { kMembrane, kMassSpring };
enum class MassModel { kLumped, kConsistent };
enum class BendingModel { kAuto, kQuadratic, kDiscreteShell };  ///< kAuto: quadratic where flat at rest
enum class TetrahedralizeMode { kConform };
enum class UpAxis { kX, kY, kZ };
enum class ColliderShape { kPlane, kSphere, kBox, kCapsule, kMesh };
enum class LightKind { kArea, kSun, kRectangle };
enum class Pattern { kNone, kChecker, kStripes };
enum class View { kFree, kFront, kBack, kLeft, kRight, kTop, kBottom };
enum class Quantity { kSpeed, kStrain, kStress, kPressure };
enum class Projection { kPerspective, kOrthographic };
enum class Quality { kDraft, kDefault, kFinal };
enum class GroundMode { kAuto, kOn, kOff, kShadow };
enum class ColorMap { kViridis, kInferno, kMagma, kCividis, kCoolwarm };

/// How far a clip may be from the exact motion in time of its meshes: the largest over the frames of the RMS over the
/// vertices.
struct Accuracy {
  double value = 1;         ///< > 0
  std::string unit = "mm";  ///< of length ("m", "mm", ...); "px", as the camera sees the scene; or "%" of its size

  double metres() const;  ///< [m]; 0 where the unit is none of length
};

struct Time {
  double fps = 30;                            ///< frames per second of the clip [1/s]
  double duration = 3;                        ///< [s]; frame 1 is t = 0
  int substeps = 4;                           ///< simulation steps per frame
  int max_halvings = 6;                       ///< how often a step that does not converge is retried with half the size
  std::string integrator = "implicit-euler";  ///< of sim::integrators()
  std::optional<Accuracy> accuracy;           ///< steps are chosen for it; substeps is then the least number of them

  int frames() const;                                   ///< round(duration x fps), at least 1
  double step() const { return 1 / (fps * substeps); }  ///< [s]
};

struct Solver {
  std::string method = "newton";                ///< of sim::minimizers()
  std::string hessian = "auto";                 ///< of sim::hessian_modifications()
  std::string line_search = "backtracking";     ///< of sim::line_searches()
  std::string stop = "residual";                ///< of sim::stopping_tests()
  std::string linear = "auto";                  ///< of sim::linear_solvers()
  double tolerance = 1e-3;                      ///< of a step, relative to the motion it has to produce [-]
  std::string preconditioner = "block-jacobi";  ///< of sim::preconditioners(); for cg, gmres, steepest-descent
  double omega = 1.5;                           ///< relaxation of sor [-], in (0, 2)
  int restart = 50;                             ///< of gmres: vectors kept before it begins anew
  int linear_max_iterations = 0;                ///< of a linear solve by iteration; 0: 10,000, with cg 10 per unknown
  double linear_tolerance = 1e-4;               ///< of a linear solve by iteration, relative residual [-]
  int max_iterations = 50;                      ///< of the minimizer, per step
};

/// Placement of a body or collider: scale, then rotate (Euler angles, about x first, then y, then z), both about
/// `pivot`, then translate.
struct Transform {
  Vec3 translate = Vec3::Zero();  ///< [m]
  Vec3 rotate = Vec3::Zero();     ///< [deg] about x, y, z
  Vec3 scale = Vec3::Ones();      ///< [-]
  Vec3 pivot = Vec3::Zero();      ///< [m] in the coordinates of the mesh
};

/// One key frame of a motion on top of where the thing was put. Between key frames translate and each angle are
/// interpolated by themselves (so turns beyond 180 degrees count); before the first and after the last they stand.
struct MotionKey {
  double t = 0;                   ///< [s]
  Vec3 translate = Vec3::Zero();  ///< [m]
  Vec3 rotate = Vec3::Zero();     ///< [deg] about x, y, z
};

/// Axis-aligned box in world coordinates.
struct Box {
  Vec3 lo = Vec3::Zero();  ///< [m]
  Vec3 hi = Vec3::Zero();  ///< [m]
};

/// Vertices that are held, or driven by `motion`.
struct Pin {
  std::optional<Box> box;                         ///< vertices inside, after the body's transform
  std::vector<int> vertices;                      ///< and these, by number (from 0)
  std::array<bool, 3> axes = {true, true, true};  ///< held directions x, y, z
  std::vector<MotionKey> motion;                  ///< t increases
  std::optional<Vec3> pivot;  ///< [m] world, what `rotate` turns about; absent: the held vertices' mean
};

/// A mesh file as it is brought into the scene.
struct MeshSource {
  std::string path;            ///< as written, relative to the scene file; empty: no mesh. See Scene::asset_path
  double unit = 1;             ///< metres per unit of the file [m]
  UpAxis up = UpAxis::kY;      ///< the file's axis that points up
  std::optional<double> size;  ///< scales the longest side to this [m]
};

/// How things look; drawn two-sided.
struct Look {
  std::optional<Color> color;       ///< absent: the mesh file's own colours and textures, or else light grey
  std::optional<Color> back_color;  ///< of the side that the normals point away from; absent: as the front
  double roughness = 0.6;           ///< [-] 0 mirror to 1 matt
  double metallic = 0;              ///< [-] 0 or 1, or between
  std::string texture;              ///< picture file, as written; empty: the mesh file's own, if no colour is given
  std::string normal_texture;       ///< picture files in the same way; of glTF's kinds
  std::string roughness_texture;    ///< green: roughness, blue: metallic
  std::string emission_texture;
  std::optional<Color> emission;  ///< given off; absent: the mesh file's own, or with a texture white
  double emission_strength = 1;   ///< [-]
  double sheen = 0;               ///< [-] bright rim of fibres
  Pattern pattern = Pattern::kNone;
  Color pattern_color = {0.92, 0.92, 0.92};
  double pattern_size = 0.1;  ///< of a field [m]
  std::optional<Color> wire;  ///< of the triangles' edges; absent: not drawn
  double crease = 60;         ///< [deg] edges sharper than this stay hard
};

struct Block {
  Vec3 size = Vec3::Constant(0.5);       ///< [m]
  std::array<int, 3> cells = {8, 8, 8};  ///< along x, y, z; each becomes tetrahedra
};

struct Grid {
  std::array<double, 2> size = {1, 1};  ///< [m] along x, z
  std::array<int, 2> cells = {32, 32};  ///< along x, z; each becomes two triangles
};

struct Tetrahedralize {
  TetrahedralizeMode mode = TetrahedralizeMode::kConform;
  double quality = 1.4;              ///< largest ratio of circumradius to shortest edge [-]
  std::optional<double> max_volume;  ///< of one tetrahedron [m^3], after unit, size and scale
  double time_limit = 60;            ///< [s]
};

struct SolidMaterial {
  std::string preset;                        ///< its figures have been filled in below; kept for messages
  std::string model = "stable-neo-hookean";  ///< of sim::solid_materials()
  double young = 1e5;                        ///< Young's modulus [Pa]
  double poisson = 0.45;                     ///< Poisson's ratio [-]
};

struct ClothMaterial {
  std::string preset;          ///< its figures have been filled in below; kept for messages
  std::string model = "stvk";  ///< of sim::membrane_materials()
  double young = 1e5;          ///< Young's modulus [Pa]
  double poisson = 0.3;        ///< Poisson's ratio [-]
  double thickness = 1e-3;     ///< [m]
  double bending = 1e-5;       ///< bending stiffness [N m]
};

/// Stiffness of the springs of a mass-spring cloth [N/m].
struct Springs {
  std::optional<double> structural;  ///< along the edges; absent: of every edge from the material (van Gelder 1998)
  std::optional<double> shear;       ///< along the diagonals of a grid's cells; absent: half of `structural`
  std::optional<double> bend;        ///< to every second neighbour; absent: a tenth of `structural`, or of young times
                                     ///< thickness
};

/// How the surface of a soft body or cloth touches itself and others.
struct BodyContact {
  bool self = false;               ///< itself; where the file says nothing, what [contact] says
  bool others = true;              ///< other bodies, and mesh colliders
  std::optional<double> friction;  ///< Coulomb's coefficient [-]; absent: as [contact] says
  double thickness = 0;            ///< surfaces keep half of it on either side [m]
};

/// A figure of the simulation as the colour of a body.
struct DataView {
  Quantity show = Quantity::kSpeed;
  ColorMap colormap = ColorMap::kViridis;
  std::optional<std::array<double, 2>> range;  ///< values of the first and last colour; absent: of the whole clip
  double shading = 0.5;                        ///< 0: exactly the colours of the bar, 1: fully lit
  bool colorbar = true;
  std::string label;  ///< of the colour bar; empty: quantity and unit
};

/// What soft bodies and cloths have in common.
struct Body {
  std::string name;  ///< unique among bodies and colliders; made up ("soft-1") when the file gives none
  MeshSource mesh;
  Transform transform;
  MassModel mass = MassModel::kLumped;
  Vec3 velocity = Vec3::Zero();  ///< at t = 0 [m/s]
  Vec3 spin = Vec3::Zero();      ///< at t = 0 [deg/s], about the world axes through the centre of mass
  std::vector<Pin> pins;
  BodyContact contact;
  Look look;
  std::optional<DataView> data;  ///< of soft bodies and cloths
  bool visible = true;
};

struct SoftBody : Body {
  std::optional<Block> block;     ///< exactly one of `block` and `mesh.path` is given
  Tetrahedralize tetrahedralize;  ///< for a surface mesh
  SolidMaterial material;
  double density = 1000;  ///< [kg/m^3]
};

struct Cloth : Body {
  std::optional<Grid> grid;  ///< in the xz plane, centred; exactly one of `grid` and `mesh.path` is given
  ClothModel model = ClothModel::kMembrane;
  BendingModel bending_model = BendingModel::kAuto;  ///< of a membrane
  ClothMaterial material;
  Springs springs;            ///< of a mass-spring cloth
  double spring_damping = 0;  ///< of a mass-spring cloth, along each spring [N s/m]
  double density = 200;       ///< [kg/m^3]; mass per area is density x thickness

  double areal_density() const { return density * material.thickness; }  ///< [kg/m^2]
};

/// Points in a row, joined by edges.
struct Chain {
  Vec3 from = Vec3(-0.5, 0, 0);  ///< [m], in the body's coordinates
  Vec3 to = Vec3(0.5, 0, 0);     ///< [m]
  int links = 10;                ///< edges; there is one point more
};

/// Points with masses, and springs between them: oscillators, chains, pendulums. Lists hold one number for all, or one
/// for each.
struct SpringBody : Body {
  std::vector<Vec3> points;               ///< [m]; exactly one of `points` and `chain` is given
  std::vector<std::array<int, 2>> edges;  ///< numbers of points, from 0
  std::optional<Chain> chain;
  std::vector<double> masses = {0.1};     ///< of each point [kg]
  std::vector<double> stiffness = {1e3};  ///< of each edge [N/m]
  std::vector<double> rest_length;        ///< of each edge [m]; empty: the distance of its points
  double damping = 0;                     ///< along each edge [N s/m]
  std::vector<double> radius;             ///< of the drawn balls [m]; empty: from the lengths of the edges
  std::optional<double> edge_radius;      ///< of the drawn rods [m]; absent: a third of the smallest ball's
};

/// A body that another part of the scene speaks of.
struct BodyName {
  std::string name;   ///< as written
  std::string place;  ///< "soft.2": filled by the reader; names may change without changing a simulation
};

/// Forces on a part of a body that keep their size and direction.
struct Load {
  std::string name;  ///< unique among loads; made up ("load-1") when the file gives none
  BodyName body;
  std::optional<Box> box;        ///< what lies inside, after the body's transform
  std::optional<Vec3> force;     ///< in all, shared out by mass [N]; exactly one of `force` and `traction` is given
  std::optional<Vec3> traction;  ///< on the rest area of surface triangles that are all inside [Pa]
  double from = 0;               ///< [s]
  std::optional<double> until;   ///< [s], later than `from`
  double ramp = 0;               ///< time in which it rises, in a straight line [s]
};

/// Ties between vertices of a body and the surface of another.
struct Attach {
  std::string name;                 ///< unique among attachments; made up ("attach-1") when the file gives none
  std::array<BodyName, 2> bodies;   ///< vertices of the first are bound to the second
  std::optional<Box> box;           ///< which vertices, after the body's transform; absent: all
  std::optional<double> near;       ///< only those nearer than this to the second [m]
  std::optional<double> stiffness;  ///< of each tie [N/m]; absent: ten times that of the softer body around it
  double damping = 0;               ///< of each tie [N s/m]
  bool snap = false;                ///< draw the points together, whatever their distance
};

struct Gusts {
  double amplitude = 0.3;  ///< largest deviation, along and across, relative to the wind's speed [-]
  double period = 3;       ///< of the slowest [s]
  int seed = 0;
};

/// Air that moves: it presses on cloths and soft bodies, and [damping] drag is relative to it.
struct Wind {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]; zero: still air, which resists
  double density = 1.2;          ///< of the air [kg/m^3]
  double drag = 1.2;             ///< coefficient of the pressure across a surface [-]
  double friction = 0;           ///< coefficient of the shear along it [-]
  std::optional<Gusts> gusts;
};

struct Collider {
  std::string name;  ///< unique among bodies and colliders; made up ("collider-1") when the file gives none
  ColliderShape shape = ColliderShape::kPlane;
  Vec3 normal = Vec3::UnitY();    ///< of a plane, which passes through its origin; normalized by the reader
  double radius = 0.5;            ///< of a sphere or capsule [m]
  Vec3 size = Vec3::Ones();       ///< of a box, centred [m]
  double height = 1;              ///< of a capsule [m], between the centres of its ends, along y
  MeshSource mesh;                ///< of shape "mesh"; open or closed
  double thickness = 0;           ///< of a mesh: half of it on either side [m]
  double friction = 0.4;          ///< Coulomb's coefficient [-]
  Transform transform;            ///< of a sphere and capsule the scale is uniform
  std::vector<MotionKey> motion;  ///< t increases; turns about where the transform puts its origin
  Look look;
  bool visible = true;
};

/// Vertices of a field whose value is given (Dirichlet condition).
struct FixedValue {
  bool boundary = false;    ///< all vertices on the boundary of the mesh
  std::optional<Box> box;   ///< and those inside, after the field's transform
  std::string value = "0";  ///< a number, or a formula (formula.h)
};

/// A scalar field on a surface: sim/field.h.
struct Field {
  std::string name;  ///< unique among bodies, fields and colliders; made up ("field-1") when the file gives none
  std::string equation = "poisson";  ///< of sim::field_equations()
  std::optional<Grid> grid;          ///< in the xz plane, centred; exactly one of `grid` and `mesh.path` is given
  MeshSource mesh;
  Transform transform;
  double diffusivity = 1;  ///< of heat [m^2/s]
  double speed = 1;        ///< of a wave [m/s]
  MassModel mass = MassModel::kLumped;
  std::string source = "0";        ///< a number, or a formula; so are the next two
  std::string initial = "0";       ///< at t = 0
  std::string initial_rate = "0";  ///< of a wave at t = 0 [1/s]
  std::vector<FixedValue> fixed;   ///< none: nothing flows through the boundary

  double height = 0;  ///< drawn displaced along the normal by height times the value [m]
  ColorMap colormap = ColorMap::kViridis;
  std::optional<std::array<double, 2>> range;  ///< values of the first and last colour; absent: of the whole clip
  std::optional<double> shading;  ///< 0: exactly the colours of the bar, 1: fully lit; absent: 0, with a height 0.5
  bool colorbar = true;
  std::string label;  ///< of the colour bar
};

/// What holds for two surfaces, or one with itself, instead of what follows from each of them.
struct ContactPair {
  std::array<BodyName, 2> between;  ///< soft bodies, cloths, mesh colliders; twice the same: with itself
  bool touch = true;
  std::optional<double> friction;   ///< [-]
  std::optional<double> thickness;  ///< their whole distance [m]
};

struct Contact {
  bool self = false;             ///< does every cloth and soft body touch itself?
  double friction = 0.3;         ///< between surfaces of bodies, whose own it is where they give none [-]
  bool resolve_overlap = false;  ///< bodies that overlap in the first frame are moved apart, not refused
  std::vector<ContactPair> pairs;
  double distance = 2e-3;             ///< at which the penalty begins [m]
  double slip_speed = 1e-3;           ///< below which friction holds [m/s]
  std::optional<double> sleep_speed;  ///< bodies that stay slower fall asleep [m/s]; absent: slip_speed/2; 0: none does
  std::optional<double> stiffness;  ///< of the penalty k in psi = k/3 (distance - d)^3 [N/m^2]; absent: from the scene
};

struct Damping {
  double drag = 0;   ///< force per mass and velocity, relative to the wind [1/s]
  double alpha = 0;  ///< Rayleigh, of the mass [1/s]
  double beta = 0;   ///< Rayleigh, of the stiffness [s]
};

/// The motion of one body as it should be, in closed form: what `softreel study` measures errors against.
struct Reference {
  BodyName body;
  /// Displacement of a vertex from its rest position x, y, z [m] at the time t [s], as formulas (formula.h) [m].
  std::string x = "0", y = "0", z = "0";
};

/// Where the camera is at a time; what is absent stays as it is without keys.
struct CameraKey {
  double t = 0;                          ///< [s]
  std::optional<Vec3> position, target;  ///< [m]
  std::optional<double> fov;             ///< [deg]
};

struct Camera {
  std::optional<Vec3> position;          ///< [m]; absent: framed over the whole clip, seen from `direction`
  std::optional<Vec3> target;            ///< [m]; absent: the middle of what is to be seen
  Vec3 direction = Vec3(0.55, 0.35, 1);  ///< from the target to the camera, when `position` is absent [-]
  Vec3 up = Vec3::UnitY();               ///< [-]
  Projection projection = Projection::kPerspective;
  double fov = 35;               ///< vertical angle of view [deg]
  std::optional<double> height;  ///< that an orthographic picture covers [m]; absent: framed
  View view = View::kFree;       ///< sets `direction`
  std::vector<CameraKey> keys;   ///< in the order of time
  double orbit = 0;              ///< round the target, counter-clockwise seen from above [deg/s]
  std::string follow;            ///< body whose middle the camera goes along with; empty: none
  double aperture = 0;           ///< diameter of the lens [m]; 0: everything is sharp
  std::optional<double> focus;   ///< distance at which things are sharp [m]; absent: that of the target
};

struct Light {
  LightKind kind = LightKind::kArea;
  std::optional<Vec3> position;         ///< of a light at a place [m]; absent: in `direction`, three scene sizes away
  Vec3 direction = Vec3(0.5, 1, 0.35);  ///< from the scene to the light [-]
  std::optional<double> radius;         ///< of an area light [m]; absent: a tenth of its distance
  std::optional<std::array<double, 2>> size;  ///< of a rectangle, width and height [m]; absent: 0.2 of its distance
  double angle = 2;                           ///< a sun's angle of sight [deg]
  Color color = {1, 0.97, 0.92};
  double intensity = 1;  ///< [-] 1: a white surface that faces it, in the middle of the scene, comes out nearly white
  bool shadow = true;
};

/// From the top of the picture to its bottom; the same colour twice is a plain background.
struct Background {
  Color top = {0.62, 0.72, 0.83};
  Color bottom = {0.93, 0.94, 0.95};
  bool sky = false;          ///< the picture `sky_map` instead
  bool transparent = false;  ///< none: the frames have an alpha channel
};

/// The plane that things stand on and throw shadows onto; drawn only, what bodies bump into are the colliders.
struct Ground {
  GroundMode show = GroundMode::kAuto;  ///< auto: drawn unless a plane collider is visible
  std::optional<double> height;         ///< y [m]; absent: under the lowest point of the clip
  Color color = {0.72, 0.71, 0.69};
  double roughness = 0.9;  ///< [-]
  Pattern pattern = Pattern::kNone;
  Color pattern_color = {0.55, 0.55, 0.55};
  std::optional<double> pattern_size;  ///< of a field [m]; absent: a tenth of the scene, rounded
};

struct Render {
  std::array<int, 2> size = {1280, 720};  ///< width, height [pixels]
  Quality quality = Quality::kDefault;    ///< sets `samples`, where that is not given
  int samples = 16;                       ///< passes averaged into one frame; 0: as many as `tolerance` needs
  double tolerance = 0.5;                 ///< of the estimated error when samples is 0, RMS [levels of 255]
  int seed = 0;                           ///< of the sample positions
  bool animate_seed = false;              ///< another seed for each frame
  double shutter = 0;                     ///< part of the time between two frames in which light falls in, 0..1
  Background background;
  Ground ground;
  double exposure = 0;  ///< [stops]
  double sky = 1;       ///< brightness of the sky's light [-]
  std::string sky_map;  ///< picture of all directions (.hdr), as written; empty: the built-in sky
  double sky_turn = 0;  ///< of the picture about the vertical [deg]
  bool depth = false, normal = false, id = false;  ///< side channels, 16-bit PNG files beside the frames
  bool sky_shadow = true;                          ///< bodies hide the sky from one another and from the ground
};

/// A file that the scene names, and where it does so.
struct AssetUse {
  std::string key;       ///< "soft.spot.mesh"
  std::string path;      ///< as written
  bool physics = false;  ///< its content belongs to the simulation; otherwise only to the picture
  std::string file;      ///< where it is named, as in Problem
  int line = 0, column = 0;
};

struct Scene {
  std::string title;
  Vec3 gravity = Vec3(0, -9.81, 0);  ///< [m/s^2]
  Time time;
  Solver solver;
  std::vector<SoftBody> soft;
  std::vector<Cloth> cloth;
  std::vector<SpringBody> springs;
  std::vector<Field> fields;
  std::vector<Collider> colliders;
  std::vector<Load> loads;
  std::vector<Attach> attachments;
  std::optional<Wind> wind;
  Contact contact;
  Damping damping;
  std::optional<Reference> reference;
  Camera camera;
  std::vector<Light> lights;  ///< a file that does not mention lights gets one area light; `light = []` means none
  Render render;

  std::filesystem::path file;      ///< where it was read from
  std::vector<std::string> notes;  ///< what is no mistake but should be known, with file, line and column
  std::vector<AssetUse> assets;    ///< in the order of the table; filled by the reader

  /// A path of the scene file (mesh, texture), seen from the working directory.
  std::filesystem::path asset_path(const std::string& written) const;
};

}  // namespace softreel::assets
