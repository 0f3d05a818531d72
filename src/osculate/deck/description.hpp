#pragma once
// size: all that a model file may say, in one place
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/contact/law/law.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/types.hpp"
#include "osculate/deck/output_description.hpp"
#include "osculate/deck/parameters.hpp"
#include "osculate/deck/source_tree.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/geometry/nurbs_patch.hpp"
#include "osculate/geometry/surfaces.hpp"
#include "osculate/material/expansion.hpp"
#include "osculate/material/law.hpp"
#include "osculate/material/orientation.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/join.hpp"

// size: one value for all that a model file says
/// What a model file says, validated and with all defaults filled in, but not yet matched with a
/// mesh. Plain values; everything that can turn out wrong later carries the place it was read from.
namespace osculate::deck {

// ---- mesh -------------------------------------------------------------------------------------

enum class BoxSide { bottom, top };

/// A circular crown on one side of a box: at x the side is moved inwards by
/// sign(radius) (|radius| - sqrt(radius^2 - (x - at)^2)), nodes between the sides in proportion.
struct Crown {
  BoxSide side = BoxSide::bottom;
  Number radius;  ///< > 0 bulges outwards, < 0 inwards; spans the box
  Number at;      ///< x of the most protruding point; default: the middle of the box
};

/// A structured box of area cells, or of volume cells if it has breakpoints in z. All lists are per
/// interval between breakpoints (plain numbers of the model file are already repeated), so
/// elements[0].size() == breakpoints[0].value.size() - 1.
struct Box {
  std::array<Marked<std::vector<double>>, 3> breakpoints;  ///< strictly increasing; z may be empty
  std::array<std::vector<int>, 3> elements;                ///< >= 1
  std::array<std::vector<double>, 3> bias;  ///< last element size / first one, default 1
  Marked<cell::CellType> type;              ///< of the dimension of the box
  std::optional<Crown> crown;               ///< without z only
  Number angle;                             ///< degrees, applied after everything else
  Vec3 about{0, 0, 0};                      ///< centre of that rotation
  Vec3 axis{0, 0, 1};                       ///< and its axis, of any length
  [[nodiscard]] bool solid() const { return !breakpoints[2].value.empty(); }
};

/// A ring or hollow cylinder: a box of radius, angle [degrees] and, in space, height.
struct Ring {
  Box box;
  Vec3 center{0, 0, 0};
  int along = 2;  ///< axis of coordinates that it is along
};

/// A line mesh along straight intervals.
struct LineMesh {
  Marked<std::vector<Vec2>> points;  ///< consecutive ones differ
  std::vector<int> elements;         ///< per interval
  Marked<cell::CellType> type;       ///< line2, line3
};

struct GeneratedPart {
  Name name;
  std::variant<Box, Ring, LineMesh, mesh::GridSpec, mesh::TubeSpec, mesh::SphereSpec,
               mesh::BallSpec, mesh::DiscSpec>
      shape;
};

struct MeshFile {
  Name name;         ///< heads the names of its sets; empty for the one file of a model
  Name file;         ///< as written
  std::string path;  ///< `file`, relative to the folder of the model file
  mesh::Placement placement;
};

struct MeshSource {
  core::SourceMark mark;
  std::vector<MeshFile> files;
  std::vector<GeneratedPart> generated;
};

/// A set made of other sets: of the mesh, or defined before it.
struct SetDefinition {
  Name name;
  std::vector<Name> all_of;   ///< union; or
  std::optional<Name> of;     ///< what is in this set
  std::vector<Name> within;   ///< and in these,
  std::vector<Name> without;  ///< but not in these
};

// ---- bodies -----------------------------------------------------------------------------------

struct Material {
  Name name;
  Marked<material::Law> law;
  material::Expansion expansion{};
  std::vector<std::pair<std::string_view, core::SourceMark>> marks;  ///< of its parameters

  /// Where a parameter stands; the law, where it has no such parameter.
  [[nodiscard]] const core::SourceMark& mark(std::string_view parameter) const;
};

enum class SectionElement { plane_strain, plane_stress, axisymmetric, solid, solid_shell };
/// True for bodies in space.
[[nodiscard]] constexpr bool is_space(SectionElement e) { return e >= SectionElement::solid; }
enum class Kinematics { small, finite };
enum class Formulation { automatic, full, bbar, enhanced, reduced, beam };

struct Section {
  Name on;
  Name material;
  Marked<SectionElement> element;
  Number thickness;
  Marked<Kinematics> kinematics;  ///< the material's default is already applied
  Marked<Formulation> formulation;
  Marked<material::Orientation> orientation{};  ///< of the axes of its material
};

struct SetShape {
  Name set;
};
struct CircleShape {
  Vec2 center{0, 0};
  Number radius;
  bool inside = false;  ///< the body is outside the circle (a hole)
};
struct ArcShape {
  Vec2 center{0, 0};
  Number radius;
  Number from, to;  ///< degrees, from < to <= from + 360
  bool inside = false;
};
struct PolylineShape {
  Marked<std::vector<Vec2>> points;  ///< consecutive ones differ
  bool closed = false;
};
/// The half plane behind `point`; `normal` (unit) points out of the body.
struct HalfPlaneShape {
  Vec2 point{0, 0};
  Vec2 normal{0, 1};
};
struct NurbsShape {
  Marked<int> degree;
  Marked<std::vector<double>> knots;  ///< non-decreasing, control.size() + degree + 1 of them
  Marked<std::vector<Vec3>> control;  ///< x, y, weight; not pre-multiplied
};
/// Curves of which each begins where the one before ends.
struct CompositeShape {
  std::vector<geometry::Curve> parts;
  bool closed = false;  ///< the first begins where the last ends
};
/// The last ones, those of the geometry, are shapes in space.
using RigidShape =
    std::variant<SetShape, CircleShape, ArcShape, PolylineShape, HalfPlaneShape, NurbsShape,
                 CompositeShape, geometry::Plane, geometry::Sphere, geometry::Cylinder,
                 geometry::Cone, geometry::Torus, geometry::NurbsPatch>;

struct Rigid {
  Name name;
  RigidShape shape;
  std::string kind;  ///< key of the shape
  /// Two coordinates in the plane, three in space; absent: centroid of the set, centre of the
  /// shape.
  std::optional<Marked<std::vector<double>>> reference;
  /// Sets of one node each that stand for its translations and rotations in the files of CalculiX.
  std::vector<Name> reference_node{}, rotation_node{};
  std::optional<bool> flip;  ///< the body is on the other side; absent: where it belongs
  std::optional<Marked<Kinematics>> kinematics;  ///< of its rotation; absent: finite
  std::optional<Number> mass;
  std::optional<Number> density;  ///< instead of the mass; in the plane mass per area
  std::optional<Marked<std::vector<double>>> inertia;  ///< 1, 3 or 6 numbers
  [[nodiscard]] bool meshed() const { return std::holds_alternative<SetShape>(shape); }
};

// ---- contact ----------------------------------------------------------------------------------

enum class SamplingRule { automatic, nodes, gauss, lobatto, mortar };
enum class EnforcementWord { penalty, augmented_lagrange, lagrange_multiplier };
enum class AugmentLoop { uzawa, single };
enum class ContactWeight { node, reference_area, current_area };
enum class Residual { surface, full };
enum class TangentKind { consistent, covariant };
enum class HistoryKind { continuous, chord, per_facet };
enum class InitialWord { ignore, ramp, keep, adjust, clearance };
enum class SmoothingWord { none, hermite, nurbs };

enum class AreaWord { around, middles, master };

/// Of the master's surface.
struct MasterSmoothing {
  SmoothingWord kind = SmoothingWord::none;
  double angle = 30;  ///< degrees: corners with a larger one stay sharp
};

/// `consistent`, or the covariant parts that are switched on.
struct Tangent {
  TangentKind kind = TangentKind::consistent;
  bool main = true, rotational = true, curvature = true;
};

/// How the contact conditions are met; the last two are of the augmented Lagrangian.
struct Enforcement {
  EnforcementWord kind = EnforcementWord::penalty;
  std::optional<double> target;  ///< largest gap and elastic slip [length]
  AugmentLoop loop = AugmentLoop::uzawa;
};

/// Points per direction of a slave facet, or of each of its equal parts.
struct Sampling {
  SamplingRule rule = SamplingRule::nodes;
  int points = 0, subdomains = 1;
};

enum class SeparationWord { allowed, no_separation, tied_normal, tied };
enum class InitialGap { keep, close };

/// A law of contact::Law and where what is asked of it later stands.
template <class Law>
struct GivenLaw {
  Law law;
  bool automatic = false;                 ///< its stiffness, from that of the bodies
  core::SourceMark stiffness;             ///< where that is said
  std::optional<core::SourceMark> timed;  ///< of a parameter that needs durations of the steps
  core::SourceMark mark{};                ///< of the law itself
};

struct NormalDescription {
  GivenLaw<contact::NormalLaw> law;
  std::optional<GivenLaw<contact::DampingLaw>> damping;
  Marked<SeparationWord> separation;
  std::optional<Number> tolerance;
  Marked<InitialGap> initial_gap;
};

struct Contact {
  Name name;
  Name master, slave;  ///< name of a rigid body if there is one, else of a set
  Marked<Sampling> sampling;
  NormalDescription normal;
  double offset = 0;  ///< of both sides together
  std::optional<GivenLaw<contact::FrictionLaw>> friction;
  Marked<Enforcement> enforcement;
  Marked<ContactWeight> weight;
  double area = 0;                    ///< of each slave node; 0: that of its facets, or
  std::optional<AreaWord> area_by{};  ///< another share of them
  Marked<Residual> residual;
  Marked<Tangent> tangent;
  Marked<HistoryKind> history;
  Marked<MasterSmoothing> smoothing;
  Marked<InitialWord> initial;               ///< what becomes of initial overlaps
  double initial_tolerance = 0;              ///< of adjust: gaps up to this are closed too
  double initial_clearance = 0;              ///< of clearance
  std::optional<Name> initial_nodes;         ///< of adjust: these are moved, and no others
  std::optional<core::SourceMark> two_pass;  ///< where it was asked for
  std::optional<Number> search_depth;
  std::optional<Number> edges;  ///< angle [degrees] of edges that are sharp; absent: without edges
  /// All bodies with each other, with the rigid ones and with themselves: stands for the pairs that
  /// are made of the mesh, named NAME.A-B. Master and slave are empty then.
  bool all = false;
  std::vector<std::array<Name, 2>> exclude;  ///< of `all`: bodies by number, section or rigid name
  std::vector<std::array<Name, 2>> exclude_surfaces{};  ///< of `all`: sets
};

/// What changes of a pair at the beginning of a step, and stays so.
struct ContactChange {
  core::SourceMark mark;
  Name pair;
  std::optional<bool> active;
  std::optional<NormalDescription> normal;
  /// Empty: stays; with an empty law: no friction.
  std::optional<std::optional<GivenLaw<contact::FrictionLaw>>> friction;
  /// Likewise.
  std::optional<std::optional<GivenLaw<contact::DampingLaw>>> damping{};
};

/// Stresses of a set of cells before the first step, or strains without stress.
struct InitialState {
  core::SourceMark mark;
  Name on;
  Marked<std::vector<double>> value;                ///< of all points, or
  Marked<std::vector<std::vector<double>>> points;  ///< of one after the other
};
/// Cells that are taken away when a step begins, or come back.
struct CellChange {
  core::SourceMark mark;
  Name on;
  bool with_strain = false;  ///< of those that come back
};
struct MaterialChange {
  core::SourceMark mark;
  Name on, material;
};

// ---- loading ----------------------------------------------------------------------------------

/// Points (fraction of the step, factor), fractions strictly increasing in 0..1.
struct Amplitude {
  Name name;
  std::vector<std::pair<double, double>> points;
};

enum class Component { ux, uy, uz, rx, ry, rz };
inline constexpr std::size_t component_count = 6;
inline constexpr std::array<const char*, component_count> component_names{"ux", "uy", "uz",
                                                                          "rx", "ry", "rz"};
/// True for the motions that only rigid bodies have.
[[nodiscard]] constexpr bool is_rotation(Component c) { return c >= Component::rx; }
/// True for the motions of a model in the plane.
[[nodiscard]] constexpr bool is_planar(Component c) {
  return c == Component::ux || c == Component::uy || c == Component::rz;
}

/// Axes of the displacement components of a set's nodes: of a cylinder through two points of its
/// axis, or rectangular ones by the first axis and a direction in the plane of the first two.
struct LocalAxes {
  core::SourceMark mark;
  Name on;
  material::Orientation along;
};

struct EquationTerm {
  Name on;
  Component of = Component::ux;
  Number factor;
};
/// sum factor * u = value, term by term over the nodes of the sets; or for each node of the first
/// set one such equation, with the nodes of the same place in the others.
struct Equation {
  core::SourceMark mark;
  std::vector<EquationTerm> terms;
  Number value;
  bool for_each_node = false;
};
/// All nodes of the set share one displacement.
struct Equal {
  core::SourceMark mark;
  Name on;
  Component of = Component::ux;
};

/// The nodes of a set stay in one plane, on one line, or (two of them) at their distance.
struct NodeCondition {
  core::SourceMark mark;
  Name on;
};
/// The mean motion of a set's nodes is that of a rigid body; or these displacements of each are.
struct Coupling {
  core::SourceMark mark;
  Name on, rigid;
  std::array<bool, 3> of{};
  std::optional<Marked<material::Orientation>> along{};  ///< axes of `of`; absent: x, y and z

  [[nodiscard]] bool is_mean() const { return of == std::array<bool, 3>{}; }
};
/// A force that depends on one elongation: of the line between two nodes, or of a sum of
/// displacements as in equations.
struct Spring {
  core::SourceMark mark;
  std::vector<Name> between;  ///< sets of one node; none: it has terms
  std::vector<EquationTerm> terms;
  std::optional<Number> stiffness;
  Marked<std::vector<Vec2>> table;  ///< elongation, force
  struct Gap {
    core::SourceMark mark;
    double clearance = 0, stiffness = 0, tension = 0;
  };
  std::optional<Gap> gap;
  double damping = 0;
  Kinematics kinematics = Kinematics::finite;
};
struct PointMass {
  core::SourceMark mark;
  Name on;
  Number mass;  ///< of each node
};
/// A cut through a body, at a set of facets inside of it: its name is that of a set of one node
/// whose ux is by how much the cut shortens the body.
struct Pretension {
  Name name;
  Name on;
  std::optional<Name> node;  ///< set of the one node, where the mesh has it
  std::optional<Marked<Vec3>> axis;
};
/// One of `sectors` equal parts round an axis: its dependent face moves as the independent one of
/// its neighbour.
struct CyclicSymmetry {
  core::SourceMark mark;
  Name dependent, independent;
  Marked<int> sectors;
  Vec3 from{0, 0, 0}, to{0, 0, 1};
};

/// Nodes of the slave follow the master's facets.
struct Tie {
  core::SourceMark mark;
  Name slave, master;
  std::optional<Number> tolerance;
  bool adjust = true;
};

/// A load or motion of a set at the end of the step; how many of `values` are used depends on the
/// kind: motions and forces fx fy fz mx my mz are indexed by Component, pressure p, traction tx ty
/// tz, body force fx fy fz. Absent ones are not touched.
struct Load {
  core::SourceMark mark;
  Name on;
  std::array<std::optional<Number>, component_count> values;
  std::optional<Name> amplitude;
  std::optional<Number> phase;      ///< degrees, of loads that swing
  Vec3 from{0, 0, 0}, to{0, 0, 1};  ///< points of the axis, of centrifugal loads
};
using Prescription = Load;
struct Release {
  core::SourceMark mark;
  Name on;
  std::array<bool, component_count> of{};
};

enum class SchemeWord { newmark, hht, generalized_alpha, central_differences };
enum class ImpactWord { dissipative, average, plastic };
enum class MassWord { consistent, lumped };
enum class ImpactTimesWord { automatic, all, off };

/// Time integration of a step with inertia.
struct DynamicsDescription {
  core::SourceMark mark;
  SchemeWord scheme = SchemeWord::newmark;
  double parameter = 0;  ///< alpha of hht, radius of generalized_alpha
  ImpactWord impact = ImpactWord::dissipative;
  MassWord mass = MassWord::consistent;
  ImpactTimesWord impact_times = ImpactTimesWord::automatic;
  double damping_mass = 0, damping_stiffness = 0;
  double safety = 0, step = 0;  ///< of central_differences
  /// Time steps that are chosen by their errors.
  struct TimeSteps {
    core::SourceMark mark;
    double error = 0;
    std::optional<Number> smallest;
  };
  std::optional<TimeSteps> time_steps;
};

/// Linear motion of the vibrations that the step before has found.
struct ModalDescription {
  core::SourceMark mark;
  struct Ratio {
    core::SourceMark mark;
    Marked<int> first, last;
    double ratio = 0;
  };
  double ratio = 0;
  std::vector<Ratio> ratios;
  double damping_mass = 0, damping_stiffness = 0;
};

/// Vibrations that the step before has found swing with loads, at one frequency after the other.
struct HarmonicDescription {
  core::SourceMark mark;
  Number from, to;
  int points = 20;
  double bias = 3;
  ModalDescription damped;
};

/// The state that vibrations are about, or that buckles: the one before the first step, or what
/// steps led to.
enum class ModesAbout { last, start };

struct Step {
  Name name;
  Marked<int> increments;
  std::optional<Number> duration;
  std::vector<Prescription> prescribe;
  std::vector<Release> release, hold;
  std::vector<Load> forces, total_force, pressure, traction, body_force, centrifugal;
  std::vector<Load> temperature;  ///< the first value
  std::optional<DynamicsDescription> dynamics;
  std::optional<ModalDescription> modal;
  std::optional<HarmonicDescription> harmonic;
  std::optional<Marked<std::vector<double>>> gravity;
  std::vector<ContactChange> contact;
  std::vector<CellChange> remove, add;
  std::vector<MaterialChange> materials;
  std::vector<Release> free_equations;                  ///< that give these displacements, or
  std::optional<core::SourceMark> frees_all_equations;  ///< all of them
  std::optional<Marked<int>> modes;                     ///< vibrations instead of increments
  std::optional<Marked<int>> buckling;                  ///< critical loads instead of increments
  ModesAbout about = ModesAbout::last;
  std::vector<Marked<int>> diameters;     ///< of a sector of a ring
  std::optional<Number> lowest, highest;  ///< of the frequencies that the files of CalculiX list
};

// ---- solution and output ----------------------------------------------------------------------

enum class LineSearch { automatic, off };
enum class Predictor { automatic, tangent };
enum class ArcLength { automatic, always, off };
enum class Linear { automatic, direct, multigrid };

struct Solver {
  Number energy, residual;  ///< tolerances; 0 = this measure does not decide
  Marked<int> max_iterations;
  LineSearch line_search = LineSearch::automatic;
  Marked<int> cutbacks;
  std::optional<Number> minimum_fraction;
  Predictor predictor = Predictor::automatic;
  ArcLength arc_length = ArcLength::automatic;
  Linear linear = Linear::automatic;
};

struct Description {
  std::string file;  ///< name of the model file
  std::string title;
  MeshSource mesh;
  std::vector<SetDefinition> sets;
  std::vector<Setting> parameters;  ///< with the values they have had
  std::vector<Material> materials;
  std::vector<Section> sections;
  std::vector<Rigid> rigid;
  std::vector<Contact> contact;
  std::vector<Amplitude> amplitudes;
  std::vector<LocalAxes> axes;
  std::vector<Equation> equations;
  std::vector<Equal> equal;
  std::vector<NodeCondition> coplanar, collinear, fixed_distance;
  std::vector<Coupling> coupling;
  std::vector<Spring> springs;
  std::vector<PointMass> masses;
  std::vector<Pretension> pretension;
  std::vector<CyclicSymmetry> cyclic_symmetry;
  std::vector<Tie> ties;
  std::vector<Load> initial_velocity;     ///< vx vy vz wx wy wz
  std::vector<Load> initial_temperature;  ///< the first value
  std::vector<InitialState> initial_stress, initial_strain;
  std::vector<Step> steps;
  Solver solver;
  Output output;
  /// What the results depend on, as it was written: everything but `title`, `solver`, `output`.
  std::vector<SourceLeaf> source;
  std::vector<std::string> notes;  ///< what was decided for the user while reading
  bool check_only = false;         ///< a deck says that nothing is to be solved

  [[nodiscard]] const Material* find_material(const std::string& name) const;
  [[nodiscard]] const Rigid* find_rigid(const std::string& name) const;
  [[nodiscard]] const Contact* find_contact(const std::string& name) const;
  [[nodiscard]] const Amplitude* find_amplitude(const std::string& name) const;
};

}  // namespace osculate::deck
