#pragma once
// Inside of BasicSystem: explicit time integration; included by its sources only.
#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "osculate/model/force_batches.hpp"
#include "osculate/model/mass_scaling.hpp"
#include "osculate/model/system_motion.hpp"
#include "osculate/pairing/far_points.hpp"

namespace osculate::model {

/// A step with central differences, as solve::ExplicitSystem sees it.
///
/// Masses stand at the nodes and in the bodies' centres, so that every dof that moves by itself has
/// its own. All others follow: prescribed ones their ramps, nodes of rigid bodies these, eliminated
/// ones their equation. Rotations in space are kept as angular momenta.
template <int Dim>
struct BasicSystem<Dim>::Impl::Explicit {
  using Vector = Eigen::VectorXd;

  /// A displacement that is a multiple of another one, and gives it its forces and its mass.
  struct Follower {
    Dof dof, lead;
    double factor;
  };
  /// How the forces of the parts of `batches` become those of nodes. The parts do not depend on the
  /// number of threads and processes, so that the bits do not. A node of one part only gets its
  /// force from there; others have a slot in each part, and the slots are summed in order. A
  /// process evaluates its parts, gets the forces of other processes' nodes from them, and the
  /// slots of nodes that several have.
  struct Parts {
    std::size_t from = 0, to = 0;    ///< that are evaluated here
    std::vector<Index> place;        ///< of their nodes: first dof, or dofs + that of the slot
    std::vector<std::size_t> first;  ///< of a part's places, from the first one here
    std::vector<double> slots;
    std::vector<Index> shared;       ///< nodes with slots, first those of several processes
    std::vector<std::size_t> begin;  ///< of their slots
    std::size_t across = 0;          ///< nodes of several processes
    std::vector<Index> not_here;     ///< nodes that others have forces of, or several
    std::vector<std::size_t> slots_of_others;  ///< of nodes of several processes
  };
  /// What a thread works with.
  struct Work {
    BulkBlock block;
    typename ForceBatches<Dim>::Nodal along, force;         ///< of a part
    typename ForceBatches<Dim>::Matrix stiffness, scratch;  ///< of a batch
  };
  /// A rigid body in space that turns by itself: its angular momentum, and the moment on it.
  struct Turning {
    Vec3 momentum = Vec3::Zero(), moment = Vec3::Zero();
  };
  /// Springs, or dampers, on one side of the contacts: at nodes, and at rigid bodies on which the
  /// places of contact are not known.
  struct Springs {
    std::vector<double> nodes, bodies;
  };
  /// Squared frequencies of dofs that move by themselves, and of rigid bodies.
  struct Swing {
    Vector dofs;
    std::vector<double> bodies;
  };
  /// Works since the increment began.
  struct Works {
    double internal = 0, contact = 0, external = 0, damping = 0, supports = 0;
    double square = 0;  ///< of all forces of now: whether they are numbers
  };

  /// The longest time step times the frequency of the springs of contacts: measure_stable_step.
  static constexpr double faithful_share = 0.75;

  Impl& system;
  solve::CentralDifferences options;
  double damping;                 ///< by mass
  ScaledMasses scaled;            ///< what cells have beside their own mass
  std::vector<double> node_mass;  ///< of cells, at all nodes, without that: what has a weight
  /// Of dofs with their followers, with what is added; inverse: 0 where something follows.
  Vector mass, inverse;
  std::vector<const PrescribedDof*> prescribed;
  std::vector<Dof> held;  ///< prescribed dofs that are unknowns
  std::vector<Follower> followers;
  std::vector<bool> turns;  ///< per body: in space, by itself
  bool loaded = false;      ///< there are loads
  bool changes = false;  ///< stiffness: of cells with finite kinematics, laws that are not linear
  ForceBatches<Dim> batches;
  std::vector<bool> touching;  ///< cells with nodes in contact pairs
  Parts parts;
  std::vector<Work> work;     ///< for each thread one
  std::vector<Dof> gathered;  ///< dofs whose forces or whose part in the motion others have
  std::vector<pairing::ActiveSet<Dim>> active_set;
  std::vector<pairing::FarPoints<Dim>> far;  ///< likewise per pair

  // The running increment.
  State now;
  solve::ExplicitMotion motion;
  std::vector<Vec<Dim>> x;
  std::vector<Turning> turning;
  Vector past_internal, past_contact, past_external, past_damping, damping_force;
  Vector of_loads;  ///< forces, likewise gathered; for `kick`
  /// All forces on the side of the internal ones, where they are `gathered`: with the followers'.
  Vector total;
  Vector past_held;  ///< total at `held`
  Works works;
  std::vector<Works> of_turns;  ///< of the time step, some dofs after the other
  StableStep stable;
  double energy_before = 0;     ///< kinetic, at the beginning of the increment
  double held_before = 0;       ///< that of what is prescribed
  double energy_available = 0;  ///< what is there and what has been put in
  double last_step = 0;         ///< length of the last time step
  double until = 0;             ///< time at the end of the increment
  double without_way = 0;       ///< the largest `kick` and `heat` since the increment began
  Vector u_before;              ///< displacements then, where temperatures change
  bool lost = false;            ///< forces are no numbers any more
  std::string trouble;

  explicit Explicit(Impl& s);

  // solve::ExplicitSystem
  [[nodiscard]] double stable_step(const solve::ExplicitMotion& m);
  [[nodiscard]] double faithful_step() const { return stable.faithful; }
  void follow(double time, double h, solve::ExplicitMotion& m);
  [[nodiscard]] bool accelerate(double time, double h, solve::ExplicitMotion& m);
  [[nodiscard]] bool grows(const solve::ExplicitMotion& m);
  [[nodiscard]] const std::string& fault() const { return trouble; }

  [[nodiscard]] Rates begin(const State& committed, Rates rates);
  [[nodiscard]] ExplicitIncrement<State> increment(const State& committed, double fraction);

  // system_explicit.cpp
  void make_followers();
  void look_at_contact();
  void load(const State& committed);
  void place(const Vector& position);
  /// A cell by itself; false: it has no answer.
  [[nodiscard]] bool add_cell(std::size_t cell, const Vector& u, double h, Work& with);
  /// Where the forces of a place stand.
  [[nodiscard]] double* at_place(Index place) {
    Vector& internal = system.last.forces.internal;
    const auto dofs = static_cast<Index>(internal.size());
    return place < dofs ? internal.data() + place : parts.slots.data() + (place - dofs);
  }
  /// The cells of a part; the first that has no answer, or their number.
  [[nodiscard]] std::size_t add_part(std::size_t part, const Vector& u, double h, Work& with);
  /// Calls of(part, work) for the parts here, by all threads.
  template <class Of>
  void for_parts(const Of& of) {
    std::atomic<std::size_t> next = parts.from;
    system.bulk.crew.share(std::min(work.size(), parts.to - parts.from), [&](std::size_t thread) {
      for (std::size_t part; (part = next++) < parts.to;) of(part, work[thread]);
    });
  }
  /// `all`: places of points far from contact are asked for, too.
  void add_contact(double h, double fraction, bool all);
  void commit_contact();
  void add_loads(double fraction);
  void sum_forces();
  /// Adds the forces on nodes of rigid bodies to those on these, and those on what follows to those
  /// on what leads it.
  void gather(Vector& forces) const;
  /// Adds to the works, too. False: forces are no numbers.
  [[nodiscard]] bool set_accelerations(double h, solve::ExplicitMotion& m);
  void end_turns(double h);
  void add_held_works(double h, const solve::ExplicitMotion& m);
  void move_body(std::size_t body, double fraction, double h, solve::ExplicitMotion& m);
  [[nodiscard]] double kinetic(const Vector& velocity) const;
  [[nodiscard]] double kinetic_of_held(const Vector& velocity) const;
  [[nodiscard]] double kick();
  [[nodiscard]] double heat() const;
  void finish(double fraction, double duration, ExplicitIncrement<State>& out);
  /// Stored and dissipated in all cells.
  [[nodiscard]] solid::CellEnergy cells_energy(const Eigen::VectorXd& u,
                                               const std::vector<double>& memory) const;
  void add_energies(Rates& rates);
  /// Velocities and accelerations of what is prescribed at a fraction of the step, beside those of
  /// the motion; rotations in space have their spin only.
  void set_rates(double fraction, Rates& rates) const;
  [[nodiscard]] Vector inertia_forces(const Vector& acceleration) const;
  [[nodiscard]] Vec3 angular_velocity(std::size_t body) const;

  // system_explicit_parts.cpp
  void make_parts();
  void number_slots();
  [[nodiscard]] bool add_cells(const Vector& u, double h);
  void sum_slots(std::size_t begin, std::size_t end);
  void exchange_forces();
  /// The first cell of all processes that has no answer; false, and `trouble` says why.
  [[nodiscard]] bool all_have_answers(std::size_t failed, const Vector& u, double h);
  /// What the materials of other processes' parts remember.
  void exchange_memory(std::vector<double>& memory) const;
  template <class Visit>
  void for_each_job(std::size_t part, const Visit& visit) const {
    const auto fours = batches.fours(part), others = batches.alone(part);
    for (std::size_t f = fours.begin; f < fours.end; ++f)
      for (const std::size_t cell : batches.jobs(f)) visit(cell);
    for (std::size_t i = others.begin; i < others.end; ++i) visit(batches.others()[i]);
  }

  // system_explicit_masses.cpp
  /// What the step wants added, and all masses with it.
  void scale_masses();
  /// Those of nodes, with what `scaled` says; `mass` and `inverse` from them.
  std::vector<double> set_masses();
  void add_node_masses(const Springs& slave, const Springs& master, double allowed);

  // system_explicit_step.cpp
  void measure_stable_step();
  /// The largest eigenvalues of M^-1 K of cells by themselves: of all, and of those that touch.
  struct Fastest {
    double value = 0, beside = 0;
    Index cell = -1;  ///< whose `value` it is
  };
  [[nodiscard]] double mass_of(std::size_t cell, std::size_t node) const;
  [[nodiscard]] Eigen::MatrixXd scaled_stiffness(std::size_t cell, BulkBlock& block);
  void compare(std::size_t cell, double value, Fastest& fastest) const;
  void look_at(std::size_t cell, BulkBlock& block, Fastest& fastest);
  void look_at_batch(std::size_t four, Work& with, Fastest& fastest);
  [[nodiscard]] Fastest fastest_before();
  [[nodiscard]] Fastest of_all(const Fastest& here) const;
  [[nodiscard]] std::string governed() const;
  [[nodiscard]] std::string faithful_by() const;  ///< likewise, of the step that keeps the energy

  // system_explicit_contact.cpp
  [[nodiscard]] double contact_frequency(bool dampers) const;
  /// As if every point were in contact; `states` of the pairs, or nothing.
  void collect_springs(bool dampers, const std::vector<pairing::PairState<Dim>>& states,
                       Springs& slave, Springs& master) const;
  [[nodiscard]] Springs no_springs() const;
  /// Bounds of what both sides of contacts swing with: of nodes, and of rigid bodies.
  struct Bound {
    double nodes = 0, bodies = 0;
    [[nodiscard]] double most() const { return std::max(nodes, bodies); }
  };
  [[nodiscard]] static Bound bound_of(const Swing& here, const Swing& there);
  void add_springs(const pairing::PairDefinition<Dim>& pair, const std::vector<double>& slopes,
                   Springs& slave, Springs& master) const;
  [[nodiscard]] Swing swing_of(const Springs& springs) const;
  [[nodiscard]] double farthest_from(std::size_t body) const;
};

extern template struct BasicSystem<2>::Impl::Explicit;
extern template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
