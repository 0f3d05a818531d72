#pragma once
// Inside of BasicSystem; included by its sources only.
#include <array>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "osculate/la/linear_solver.hpp"
#include "osculate/model/stopwatch.hpp"
#include "osculate/model/system.hpp"
#include "osculate/model/terms/contact_term.hpp"
#include "osculate/model/terms/load_term.hpp"
#include "osculate/model/terms/resistance.hpp"
#include "osculate/model/terms/rigid_term.hpp"
#include "osculate/model/terms/spring_term.hpp"

namespace osculate::model {

template <int Dim>
struct BasicSystem<Dim>::Impl {
  using BulkBlock = BasicBulkBlock<Dim>;

  const BasicModel<Dim>& model;
  BasicDofSpace<Dim> dofs;
  // The terms.
  BulkTerm<Dim> bulk;
  ContactTerm<Dim> contact;
  ConstraintTerm<Dim> constraints;
  SpringTerm<Dim> springs;
  LoadTerm<Dim> loads;
  Resistance<Dim> resistance;
  std::array<bool, 4> enabled{true, true, true, true};
  // What they add to, and what the last evaluation has left behind.
  la::MatrixBuilder builder;
  bool pattern_reserved = false;  ///< whoever asks for no matrix pays for none
  BasicAssembler<Dim> assembler;
  la::Symmetry symmetry;
  bool nearly_symmetric;
  Evaluated<Dim> last;
  std::deque<ContactStates> recent;         ///< of the running attempt
  double assembly_seconds = 0;              ///< beside those of the terms
  int built = 0;                            ///< how often anew
  std::vector<Index> changing;              ///< rows of tangents without what is constant
  bool with_stresses = false;               ///< tangents have what stresses do in small strain
  LoadPlaces places = LoadPlaces::strains;  ///< where loads act that follow bodies
  // The running step.
  Step step;
  std::vector<bool> touched;    ///< by pair, in explicit time integration
  std::function<bool()> asked;  ///< whether iterations are to end
  const core::Ranks* ranks;     ///< who work on this together; null: this process is alone
  std::vector<int> owner;       ///< of the nodes, since they share for the first time
  double unevenness = 1;        ///< of contact among them (better_owners), of the first process

  Impl(const BasicModel<Dim>& m, int threads, const core::Ranks* of);
  /// The processes share cells and rows from here on, if there are several; where they do already
  /// and contact has moved, by other owners (better_owners). False: all is as it was.
  bool share(std::span<const pairing::PairState<Dim>> contact_now);
  /// Each does all of it.
  void share_no_more();
  /// Before another builder takes the place of this one: the entries that contact has had, on all
  /// processes.
  std::vector<la::MatrixPlace> grown_by_all();
  /// A matrix anew, with these entries of contact.
  void begin_matrix(std::span<const la::MatrixPlace> grown);
  /// Unknowns whose motion is prescribed have nothing but their diagonal in the matrix: where they
  /// are others than before, it begins anew.
  void prescribe(std::vector<bool> unknowns);
  /// The places of all cells in the matrix.
  void reserve_pattern();
  /// Where cells do not clear the matrix themselves.
  void begin_tangent();

  [[nodiscard]] bool flies_apart(const State& committed, const State& trial,
                                 solve::Evaluation& out) const;

  // Steps with inertia, in system_motion.hpp; others have none.
  struct Motion;
  std::shared_ptr<Motion> motion;
  [[nodiscard]] bool timed() const;
  [[nodiscard]] double force_factor() const;
  /// What the rounding of coordinates does to the forces of inertia and of contact.
  [[nodiscard]] double round_off_in_time(std::span<const Vec<Dim>> x) const;
  // States that are left by little, in system_vibrations.cpp.
  /// Prediction from a state, contacts sticking, with what its stresses do to the stiffness.
  void predict_about(const State& state, double fraction, bool turn, solve::Evaluation& out);
  /// Motions of all nodes and rigid bodies by a small one of the unknowns, without what is
  /// prescribed. Linear in the motion: rigid bodies turn by little.
  [[nodiscard]] Eigen::VectorXd motion_of_all(std::span<const Vec<Dim>> x, const State& state,
                                              const Eigen::VectorXd& unknowns) const;
  // Of buckling, in system_buckling.cpp.
  [[nodiscard]] Eigen::VectorXd added_internal(const Strained& before, const Strained& after);
  [[nodiscard]] Eigen::VectorXd added_external(const State& state);

  /// What is in balance: all forces on the side of the internal ones.
  [[nodiscard]] Eigen::VectorXd total_force() const;
  /// The drivers of the running step.
  void begin_drivers();

  // Explicit time integration, in system_explicit.cpp; steps without have none.
  struct Explicit;
  std::shared_ptr<Explicit> explicit_motion;
  [[nodiscard]] Rates begin_explicit_rates(const State& committed);
  /// Nodes of rigid bodies get the velocities of their bodies.
  void move_with_bodies(const State& s, Rates& rates) const;

  [[nodiscard]] bool on(Term term) const { return enabled[static_cast<std::size_t>(term)]; }
  [[nodiscard]] std::vector<Vec<Dim>> positions(const Eigen::VectorXd& u) const;
  [[nodiscard]] Eigen::VectorXd dof_values(const State& s) const;
  [[nodiscard]] double current_value(const State& s, Dof dof) const;
  [[nodiscard]] double equation_value(const Equation& equation, double fraction) const;
  void add_to(State& s, Dof dof, double value) const;
  /// Increment of every primary dof that follows from prescriptions alone (unknowns fixed).
  [[nodiscard]] Eigen::VectorXd prescribed_increment(const State& s, std::span<const Vec<Dim>> x,
                                                     double fraction) const;

  /// What an evaluation is for.
  enum class Pass {
    predict,  ///< the first iteration: prescribed motions enter through the tangent
    iterate,  ///< places far from the master are not needed (ActiveSet::near)
    whole     ///< of a state against itself: all of it is wanted
  };
  /// Residual and tangent of `trial`.
  void assemble(const State& committed, const Trial& trial, double fraction, bool with_tangent,
                Pass pass, solve::Evaluation& out);
  /// What terms add to; `inc` may be null.
  [[nodiscard]] Assembly<Dim> assembly(bool with_tangent = false,
                                       const Eigen::VectorXd* inc = nullptr) {
    return {dofs, assembler, builder, last, with_tangent, inc, force_factor()};
  }
  bool add_bodies(const State& committed, const State& now, double duration,
                  const CellInertia<Dim>* inertia, Assembly<Dim>& to, solve::Evaluation& out);
  void assemble_terms(const State& committed, const Trial& trial, double fraction,
                      bool with_tangent, Pass pass, solve::Evaluation& out);
  // Its parts: loads; what turns with rigid bodies and moments.
  void add_loads(const State& now, double fraction, bool with_tangent, Assembly<Dim>& to);
  void add_turning(const State& now, std::span<const Vec<Dim>> x, bool with_tangent,
                   Assembly<Dim>& to);
  /// What the first process has found counts for all: last bits may be the heap's.
  void spread(solve::Evaluation& out) const;
  /// Residual and its measures, of the last evaluation.
  void report(std::span<const Vec<Dim>> x, bool predict, solve::Evaluation& out) const;

  /// Time from a committed state to a fraction of the running step. A committed state at the end of
  /// a step is the start of the next one.
  [[nodiscard]] double time_between(const State& committed, double fraction) const {
    const double begin = committed.fraction < fraction ? committed.fraction : 0.0;
    return (fraction - begin) * step.duration;
  }
};

extern template struct BasicSystem<2>::Impl;
extern template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
