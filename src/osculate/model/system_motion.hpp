#pragma once
// Inside of BasicSystem: steps with inertia; included by its sources only.
#include "osculate/model/system_impl.hpp"

namespace osculate::model {

/// A step with inertia: what belongs to the step, and to the running increment. Explicit time
/// integration has its masses, and what is prescribed, from here.
template <int Dim>
struct BasicSystem<Dim>::Impl::Motion {
  Impl& system;
  const BasicModel<Dim>& model;
  const BasicDofSpace<Dim>& dofs;
  const Step& step;
  BasicAssembler<Dim>& assembler;
  Evaluated<Dim>& last;

  // The step.
  Dynamics settings;
  BasicInertia<Dim> inertia;
  std::vector<Eigen::MatrixXd> damping;  ///< of the cells, by stiffness; empty: none
  std::vector<typename SpringTerm<Dim>::Damper> dampers;  ///< of springs
  bool turns = false;         ///< the mass matrix changes with the configuration
  std::vector<bool> coupled;  ///< bodies in space whose rotation it has
  bool mass_known = false;    ///< the mass matrix is factored
  std::string failure;        ///< why it could not be; empty: it could
  la::MatrixBuilder builder;  ///< of the mass matrix of the unknowns
  std::unique_ptr<la::LinearSolver> solver = la::make_default_solver();  ///< of the mass matrix
  std::vector<bool> massless;                                            ///< unknowns
  // The running increment.
  double h = 0;       ///< its length; 0: none
  double target = 0;  ///< fraction of the step at its end
  solve::StepFactors factors;
  Eigen::VectorXd start;                          ///< primary dofs of the committed state
  std::vector<body::BasicRigidMotion<Dim>> from;  ///< rigid bodies of the committed state
  Rates past;                                     ///< of the committed state
  /// Forces of the committed state, those on nodes of rigid bodies moved to the bodies (moments
  /// in space about fixed axes).
  Eigen::VectorXd past_force;
  Eigen::VectorXd correction;  ///< of the velocity that damps, for what is prescribed
  Eigen::VectorXd effective, damping_force;
  double size_of_mass = 0;                          ///< norm of the diagonal of the mass matrix
  std::vector<pairing::PairEvaluation<Dim>> paths;  ///< of the pairs, for impacts to come
  Eigen::VectorXd speeds;        ///< at the beginning of the step; empty: errors are not estimated
  std::vector<Vec<Dim>> mass_x;  ///< configuration of the mass matrix
  std::vector<body::BasicRigidMotion<Dim>> mass_rigid;

  explicit Motion(Impl& whole);

  // system_dynamics.cpp
  void measure_damping(const State& committed);
  void place_dampers(const State& committed);
  void begin_increment(const State& committed, double fraction, double duration);
  void add_inertia(const State& trial, Assembly<Dim>& to);
  /// Rotations of rigid bodies in space, in system_spins.cpp.
  void add_spins(const State& trial, Assembly<Dim>& to);
  void begin_spins(const State& committed, const Eigen::VectorXd& force, Rates& rates) const;
  /// Adds the moments that damp turning.
  void damp_spins(const Eigen::VectorXd& velocity, Eigen::VectorXd& damping) const;
  /// `impulse`: accelerations by contact, whose moments go to `of_impulse`.
  void new_spins(const State& trial, const Eigen::VectorXd& impulse,
                 const Eigen::VectorXd& left_over, Rates& now, Eigen::VectorXd& of_impulse) const;
  void add_spin_damping(const State& trial, std::size_t body,
                        const body::InertiaMoment<3>& inertial, Assembly<Dim>& to);
  [[nodiscard]] double spin_energy(const Rates& rates) const;
  /// Moment of forces on the nodes of a rigid body about its centre, axes fixed in space.
  [[nodiscard]] Vec<body::rotations<Dim>> moment_on(const State& s, std::size_t body,
                                                    const Eigen::VectorXd& forces_on_dofs) const;
  [[nodiscard]] bool turns_body(Dof dof, std::size_t body) const;  ///< is a rotation of it
  /// Number of rotations of a body that the running step does not prescribe.
  [[nodiscard]] int free_rotations(std::size_t body) const;
  /// Rotations of it are prescribed in the running step, or part of an equation.
  [[nodiscard]] bool turns_by_rule(std::size_t body) const;
  /// Its total rotation vector is prescribed, now or in a later step, or part of an equation.
  [[nodiscard]] bool total_matters(std::size_t body) const;
  /// Bodies in space that have turned far go on from another base.
  void rebase(State& state) const;
  [[nodiscard]] CellInertia<Dim> cell_inertia() const;
  /// What is in balance in a step in time.
  [[nodiscard]] Eigen::VectorXd balance() const;
  [[nodiscard]] Eigen::VectorXd damping_of(const Eigen::VectorXd& velocity) const;
  void factor_mass();
  /// M^-1 f over all primary dofs, prescribed ones zero.
  [[nodiscard]] Eigen::VectorXd accelerations_by(const Eigen::VectorXd& force);
  [[nodiscard]] Eigen::VectorXd spread(const Eigen::VectorXd& of_unknowns) const;
  [[nodiscard]] double contact_energy() const;
  [[nodiscard]] double friction_work() const;
  [[nodiscard]] double damping_work() const;  ///< of contact
  [[nodiscard]] Rates begin_rates(const State& committed);
  [[nodiscard]] Rates new_rates(const State& trial);

  // What is prescribed and what follows, in system_driven.cpp. Rotations of bodies in space count
  // by the rates of their rotation vectors here.
  /// Rates of what is prescribed, over the primary dofs; zero elsewhere.
  struct Driven {
    Eigen::VectorXd velocity, acceleration;
  };
  /// `spacing`: fraction of the step in an increment.
  [[nodiscard]] Driven driven(double fraction, double spacing) const;
  /// Velocities of what follows from the unknowns while these stand: the equations' constants.
  [[nodiscard]] Eigen::VectorXd moving_constants() const;
  /// Accelerations of what follows while the unknowns are not accelerated, with these velocities.
  [[nodiscard]] Eigen::VectorXd turning_accelerations(const Eigen::VectorXd& velocity) const;
  [[nodiscard]] Eigen::VectorXd momenta_of(const Eigen::VectorXd& rates) const;
  [[nodiscard]] Eigen::VectorXd settled(const Eigen::VectorXd& by_scheme,
                                        const Eigen::VectorXd& prescribed,
                                        const Eigen::VectorXd& constant,
                                        const Eigen::VectorXd& force);
  [[nodiscard]] Eigen::VectorXd rotation_rates(const Eigen::VectorXd& velocity) const;
  void set_rotations(const Eigen::VectorXd& rates, Eigen::VectorXd& velocity) const;
  /// Velocities given for the beginning, and which dofs have one.
  struct Given {
    Eigen::VectorXd velocity;
    std::vector<bool> told;
  };
  [[nodiscard]] Given given_velocity() const;
  [[nodiscard]] Eigen::VectorXd start_velocity(const Driven& prescribed);
  void settle_velocities(Rates& now, const Driven& prescribed);
  void settle_accelerations(Rates& now, const Driven& prescribed, const Eigen::VectorXd& force);
  void begin_coupled_spins(Rates& rates, Eigen::VectorXd& force) const;
  [[nodiscard]] Eigen::VectorXd inertia_of(const Rates& rates) const;
  [[nodiscard]] Eigen::VectorXd unbalanced() const;
  [[nodiscard]] double kinetic_energy(const Rates& rates) const;
  void correct_damping();
  void move_past_to_bodies();
  [[nodiscard]] Eigen::VectorXd spin_force(const Rates& before, const Rates& now) const;
  void add_energies(const State& trial, const Rates& now, const Eigen::VectorXd& step,
                    double left_over, Energies& e) const;

  // Impacts that increments end at, in system_impacts.cpp.
  [[nodiscard]] bool watches(std::size_t pair, std::size_t point) const;
  [[nodiscard]] bool watches_any(std::size_t pair) const;
  void evaluate_path(const State& committed, std::size_t pair, std::span<const Vec<Dim>> x,
                     double duration);
  using PointName = std::array<std::size_t, 2>;  ///< pair and point
  /// The watched points that have met an obstacle after a time with the committed velocity.
  std::vector<PointName> met_on_path(const State& committed, double duration);
  /// How fast points sink into what they have met, from the gaps a little later.
  std::vector<double> speeds_on_path(const State& committed, const std::vector<PointName>& points,
                                     double duration, double more);
  /// Multipliers that are no guess of the next increment's: of impulses.
  void forget_impulses(std::vector<pairing::PairMultipliers<Dim>>& multipliers) const;
  [[nodiscard]] std::optional<solve::ImpactAhead> impact_ahead(const State& committed,
                                                               double fraction);

  // Errors of steps in time, in system_time_error.cpp.
  /// Velocities of all dofs, those of turning bodies in space about their own axes.
  [[nodiscard]] Eigen::VectorXd speeds_of(const Rates& rates) const;
  /// sqrt(w . M w), w as `speeds_of` has it.
  [[nodiscard]] double size_by_mass(const Eigen::VectorXd& w) const;
  [[nodiscard]] Eigen::VectorXd free_accelerations(const Rates& before, const Rates& after);
  void add_spin_errors(const Rates& before, const Rates& after, double h,
                       Eigen::VectorXd& error) const;
  [[nodiscard]] solve::TimeError time_error(const State& committed, const State& next);
};

extern template struct BasicSystem<2>::Impl::Motion;
extern template struct BasicSystem<3>::Impl::Motion;

}  // namespace osculate::model
