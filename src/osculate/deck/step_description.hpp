#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/deck/constraint_description.hpp"
#include "osculate/deck/contact_description.hpp"

// What acts at first and in the steps of a model file; a part of Description.
namespace osculate::deck {

/// Points (fraction of the step, factor), fractions strictly increasing in 0..1.
struct Amplitude {
  Name name;
  std::vector<std::pair<double, double>> points;
};

/// Where centrifugal forces act: at the places that bodies have come to or at the undeformed ones;
/// `automatic`: at the former of bodies of finite strain, and of all in small motions about a
/// state.
enum class LoadPlacesWord { automatic, deformed, undeformed };

/// A load or motion of a set at the end of the step; how many of `values` are used depends on the
/// kind: motions and forces fx fy fz mx my mz are indexed by Component, pressure p, traction tx ty
/// tz, body force fx fy fz. Absent ones are not touched.
struct Load {
  core::SourceMark mark;
  Name on;
  std::array<std::optional<Number>, component_count> values;
  std::optional<Name> amplitude;
  std::optional<Number> phase;                        ///< degrees, of loads that swing
  Vec3 from{0, 0, 0}, to{0, 0, 1};                    ///< points of the axis, of centrifugal loads
  LoadPlacesWord places = LoadPlacesWord::automatic;  ///< of these, too
};
using Prescription = Load;
struct Release {
  core::SourceMark mark;
  Name on;
  std::array<bool, component_count> of{};
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
  /// Of central_differences.
  struct MassScaling {
    std::optional<double> stable_step;
    double factor = 1;
  };
  MassScaling mass_scaling;
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
  bool at_once = false;
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
  std::vector<Equation> equations;                      ///< that begin
  std::vector<Release> free_equations;                  ///< that give these displacements, or
  std::optional<core::SourceMark> frees_all_equations;  ///< all of them
  std::optional<Marked<int>> modes;                     ///< vibrations instead of increments
  std::optional<Marked<int>> buckling;                  ///< critical loads instead of increments
  ModesAbout about = ModesAbout::last;
  std::vector<Marked<int>> diameters;     ///< of a sector of a ring
  std::optional<Number> lowest, highest;  ///< of the frequencies that the files of CalculiX list
};

}  // namespace osculate::deck
