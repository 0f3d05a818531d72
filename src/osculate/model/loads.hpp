#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/core/types.hpp"
#include "osculate/model/dof_space.hpp"
#include "osculate/solve/central_differences.hpp"
#include "osculate/solve/time_scheme.hpp"

namespace osculate::model {

/// Piecewise linear factor over the fraction of a step; empty = linear ramp.
using Amplitude = std::vector<std::pair<double, double>>;

/// Value of a channel that goes from `start` to `target` over a step. With an amplitude the value
/// is target * amplitude(fraction); without, the ramp is linear.
struct Ramp {
  double start = 0, target = 0;
  Amplitude amplitude;
  [[nodiscard]] double value(double fraction) const;
};

/// A dof with a given value. `ramp.start` is set when the step begins, from the converged state;
/// with `hold` the value stays there.
struct PrescribedDof {
  Dof dof;
  Ramp ramp;
  bool hold = false;
  bool further = false;  ///< its target counts from where it is when the step begins
};

/// Dead load: factor(t) times a force vector over the primary dofs (sparse). What acts on the
/// rotations of a rigid body is a moment about axes fixed in space (2D: about z); in space such a
/// moment has no potential.
struct DeadLoad {
  std::vector<std::pair<Dof, double>> unit;
  Ramp ramp;
};

/// Pressure on boundary facets of bulk cells (positive pushes into the body): edges in the plane,
/// faces in space. It follows the deformation for finite kinematics.
struct PressureLoad {
  struct Facet {
    Index section;             ///< whose thickness and kinematics apply
    std::vector<Index> nodes;  ///< cell order; 2D: body on the right; 3D: r_1 x r_2 points outwards
    cell::CellType type = cell::CellType::line2;  ///< of faces; an edge is known by its nodes
  };
  using Edge = Facet;
  std::vector<Facet> facets;
  Ramp ramp;
};

/// Forces of bodies that turn about an axis, at the places that they have come to: they grow as
/// these move outwards. `ramp`: the square of the angular velocity.
///
/// Formula    f_i = w^2 sum_j M_ij P (X_j + u_j - p) , df_i/du_j = w^2 M_ij P , P = 1 - e e^T ,
///            M_ij = int rho N_i N_j dV , w^2 the ramp, p a point of the axis, e along it
/// Sign       their part of the stiffness, -w^2 M P, is symmetric and softens
/// Tested by  tests/unit/deck/test_centrifugal.cpp, verification/spin_softening
struct CentrifugalLoad {
  struct Cell {
    std::vector<Index> nodes;  ///< of a cell; or one with a mass
    Eigen::MatrixXd mass;      ///< by pairs of them
    bool moves = true;         ///< else u counts in small motions about a state alone
  };
  std::shared_ptr<const std::vector<Cell>> cells;
  Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ();
  Ramp ramp;
};

/// Which places loads that follow bodies act at.
///
/// strains  of bodies of small strain, and of loads that are told to: the undeformed ones
/// state    those of the state, in small motions about it
enum class LoadPlaces { strains, state };

/// Which impacts increments in time end at.
///
/// automatic  those of points of rigid bodies with a mass, unless contact forces enter as all
///            others do (solve::Impact::average): then increments resolve them
/// all        those of all contact points
enum class ImpactTimes { automatic, all, off };

/// How long the time steps of an implicit integration are.
struct TimeStepLengths {
  double error = 1e-3;  ///< rate of the error over the largest speed (solve::TimeAccuracy)
  double smallest = 0;  ///< time step that is not shortened any more
};

/// Mass that cells get in an explicit step so that its time steps can be longer: no weight, and
/// nothing in other steps.
struct MassScaling {
  double stable_step = 0;  ///< which cells by themselves reach at least; 0: mass for none
  double factor = 1;       ///< of the mass of all cells, before
};

/// A step in time with inertia.
///
/// Formula    damping forces C v, C = damping_mass M + damping_stiffness K (Rayleigh), K the
///            stiffness of the cells at the beginning of the increment: turning is not damped by it
struct Dynamics {
  solve::TimeScheme scheme;
  bool lumped = false;  ///< masses at the nodes alone
  double damping_mass = 0, damping_stiffness = 0;
  ImpactTimes impact_times = ImpactTimes::automatic;
  /// Explicit, instead of `scheme`: masses at the nodes, damping by mass alone.
  std::optional<solve::CentralDifferences> explicit_steps{};
  std::optional<TimeStepLengths> time_steps{};  ///< none: the nominal increments
  MassScaling mass_scaling{};                   ///< with `explicit_steps`
};

/// Free vibrations about the state that the steps before led to, or about the one they began with.
struct Frequencies {
  int modes = 1;
  bool unloaded = false;  ///< about the latter
  /// Of a sector of a ring: around which the motions of the sectors turn so many times.
  std::vector<int> diameters{};
};

/// Buckling of such a state by what the loads of the step add to it.
struct BucklingSearch {
  int factors = 1;
  bool unloaded = false;  ///< of the state before the first step
};

/// Damping of vibrations that are superposed: a ratio, of some of them another one, and Rayleigh's.
struct ModalDamping {
  struct Ratio {
    std::size_t first = 1, last = 1;  ///< vibrations from 1 on, both included
    double ratio = 0;
  };
  double ratio = 0;
  std::vector<Ratio> ratios{};  ///< the last one of a vibration counts
  double mass = 0, stiffness = 0;
};

struct Step;

/// Loads and supports that swing, at one frequency after the other: those of the step are the real
/// parts, `imaginary` has the others. Their tables are over the frequencies, 0 at `from`, 1 at
/// `to`.
///
/// Sign       a load f swings as Re(f exp(i w t)), w = 2 pi frequency
struct Harmonic {
  double from = 0, to = 0;
  int points = 20;  ///< between two frequencies of vibrations, both included
  double bias = 3;  ///< how much closer they are to these
  ModalDamping damping{};
  std::shared_ptr<const Step> imaginary{};
};

/// Temperatures of nodes over a step.
///
/// Tested by  tests/unit/model/test_temperatures.cpp
struct Temperatures {
  struct Change {
    std::vector<Index> nodes;
    double target = 0;
    Amplitude amplitude;
  };
  std::vector<double> start;    ///< of all nodes; empty: no temperature is known
  std::vector<Change> changes;  ///< the last one of a node counts
  [[nodiscard]] std::vector<double> at(double fraction) const;
};

/// Everything that acts during one step, compiled from the model file.
struct Step {
  std::string name;
  int increments = 1;
  double duration = 0;   ///< time from its beginning to its end; 0: no time is known
  bool at_once = false;  ///< of that materials see nothing: they neither creep nor relax
  std::vector<PrescribedDof> prescribed;
  std::vector<DeadLoad> dead;
  std::vector<PressureLoad> pressure;
  std::vector<CentrifugalLoad> centrifugal{};
  std::optional<Dynamics> dynamics;          ///< empty: without inertia
  std::optional<Frequencies> frequencies{};  ///< nothing moves: vibrations are looked for
  std::optional<BucklingSearch> buckling{};  ///< nothing moves: critical loads are looked for
  /// The vibrations of the last step that looks for them move, and nothing else.
  std::optional<ModalDamping> modal{};
  std::optional<Harmonic> harmonic{};  ///< they swing with loads that do
  Temperatures temperature;
  std::vector<Ramp> gravity;                    ///< acceleration in every direction; empty: none
  double equation_start = 1, equation_end = 1;  ///< ramp of the constants of the equations
};

/// True for steps over whose duration bodies with a mass move.
[[nodiscard]] inline bool takes_time(const Step& step) { return step.dynamics || step.modal; }
/// Steps of increments or time steps from state to state, not of motions along vibrations.
[[nodiscard]] inline bool finds_balance(const Step& step) {
  return !step.frequencies && !step.buckling && !step.harmonic && !step.modal;
}
/// Steps whose increments are found by Newton's method.
[[nodiscard]] inline bool iterates(const Step& step) {
  return finds_balance(step) && !(step.dynamics && step.dynamics->explicit_steps);
}

/// Fractions of a step at which tables of amplitudes have corners: where the slope changes by more
/// than a tenth of the steepest slope of the table. The points of a smooth curve are none.
///
/// Tested by  tests/unit/deck/test_time_steps.cpp
[[nodiscard]] std::vector<double> corners(const Step& step);

}  // namespace osculate::model
