// Free vibrations about a state.
#include <array>

#include "osculate/model/system_motion.hpp"
#include "osculate/solid/points.hpp"

namespace osculate::model {
namespace {

/// Inertia of a rigid body in the directions of its dofs: of rotations in space those of its
/// rotation vector on top of the base.
Mat<3, 3> mass_of_body(const BasicInertia<2>& inertia, const BasicRigidBody<2>&,
                       const body::RigidMotion&, std::size_t b) {
  return inertia.body_mass(b);
}
Mat<6, 6> mass_of_body(const BasicInertia<3>& inertia, const BasicRigidBody<3>& body,
                       const body::RigidMotion3& motion, std::size_t b) {
  Mat<6, 6> mass = inertia.body_mass(b);
  const Mat<3, 3> turn = motion.orientation(), t = body::spin_tangent(motion);
  mass.bottomRightCorner<3, 3>() = t.transpose() * turn * body.inertia * turn.transpose() * t;
  return mass;
}

/// Rotation vectors' rates of a body that turns with the unit angular velocities.
Mat<1, 1> rates_of_turns(const body::RigidMotion&) { return Mat<1, 1>::Identity(); }
Mat<3, 3> rates_of_turns(const body::RigidMotion3& motion) {
  return body::spin_tangent(motion).inverse();
}

/// The unknowns' parts of the rigid motions of the whole: by columns displacements along the axes
/// and rotations around them, in the plane around the last one. A row of each of `rows` unknowns:
/// multipliers, which come last, do not move.
template <int Dim>
Eigen::MatrixXd rigid_motions(const BasicDofSpace<Dim>& dofs, const BasicAssembler<Dim>& assembler,
                              std::span<const Vec<Dim>> x, const BasicState<Dim>& state,
                              Index rows) {
  constexpr int motions = body::motions<Dim>;
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(rows, motions);
  const body::BasicRigidMotion<Dim> still{};
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    if (assembler.prescribed(u)) continue;
    const Dof dof = dofs.dof_of_unknown(u);
    if (dof < Dim * dofs.nodes()) {
      r.row(u) = body::motion_gradient(still, x[static_cast<std::size_t>(dof / Dim)])
                     .row(static_cast<Eigen::Index>(dof % Dim));
      continue;
    }
    const Dof of_bodies = dof - Dim * dofs.nodes();
    if (of_bodies >= motions * static_cast<Dof>(state.rigid.size())) continue;
    const body::BasicRigidMotion<Dim>& motion =
        state.rigid[static_cast<std::size_t>(of_bodies / motions)];
    const auto i = static_cast<int>(of_bodies % motions);
    if (i < Dim)
      r.row(u) = body::motion_gradient(still, motion.center()).row(i);
    else
      r.row(u).template tail<motions - Dim>() = rates_of_turns(motion).row(i - Dim);
  }
  return r;
}

/// Which columns are rigid motions, and their places in space: x, y, z, rotations around these. A
/// ring has one of them, along its axis.
std::vector<std::array<Eigen::Index, 2>> places_in_space(const BasicModel<2>& model) {
  for (const BasicBulkSection<2>& section : model.sections)
    if (solid::is_ring(section.section)) return {{1, 1}};
  return {{0, 0}, {1, 1}, {2, 5}};
}
std::vector<std::array<Eigen::Index, 2>> places_in_space(const BasicModel<3>&) {
  return {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}};
}

}  // namespace

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::motion_of_all(std::span<const Vec<Dim>> x,
                                                      const State& state,
                                                      const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(dofs.dofs());
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (!assembler.prescribed(u)) all[dofs.dof_of_unknown(u)] = unknowns[u];
  for (Index node = 0; node < dofs.nodes(); ++node) {
    const Index b = dofs.body_of(node);
    if (b < 0) continue;
    const Mat<Dim, body::motions<Dim>> j = body::motion_gradient(
        state.rigid[static_cast<std::size_t>(b)], x[static_cast<std::size_t>(node)]);
    all.template segment<Dim>(Dim * node) =
        j * all.template segment<body::motions<Dim>>(dofs.body_dof(b, 0));
  }
  for (const Equation& equation : dofs.equations()) {
    double sum = 0;
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      sum += equation.terms[t].factor * all[equation.terms[t].dof];
    all[equation.terms.front().dof] = -sum / equation.terms.front().factor;
  }
  return all;
}

template <int Dim>
void BasicSystem<Dim>::Impl::predict_about(const State& state, double fraction, bool turn,
                                           solve::Evaluation& out) {
  contact.friction = Prediction::sticking;
  recent.clear();
  with_stresses = true;
  places = turn ? LoadPlaces::state : LoadPlaces::strains;
  assemble(state, {state}, fraction, true, Pass::predict, out);
  with_stresses = false;
  places = LoadPlaces::strains;
}

template <int Dim>
std::string BasicSystem<Dim>::vibration_matrices(const State& state, la::SparseMatrix& stiffness,
                                                 la::SparseMatrix& mass) {
  Impl& s = *impl_;
  const BasicInertia<Dim> inertia(s.model, false);
  if (!(inertia.total() > 0)) return "nothing has a mass";
  const std::vector<Vec<Dim>> x = s.positions(state.u);
  s.reserve_pattern();
  s.builder.clear();
  s.assembler.set_configuration(x, state.rigid);
  for (const auto& cell : inertia.cells()) {
    std::vector<Dof> dofs;
    const auto nodes = static_cast<Eigen::Index>(cell.nodes.size());
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(Dim * nodes, Dim * nodes);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      for (int d = 0; d < Dim; ++d)
        dofs.push_back(s.dofs.node_dof(cell.nodes[static_cast<std::size_t>(i)], d));
      for (Eigen::Index j = 0; j < nodes; ++j)
        mass.template block<Dim, Dim>(Dim * i, Dim * j).diagonal().setConstant(cell.mass(i, j));
    }
    s.assembler.add_block(dofs, mass);
  }
  for (std::size_t b = 0; b < s.model.rigid.size(); ++b) {
    if (!inertia.body_has_mass(b)) continue;
    std::array<Dof, body::motions<Dim>> dofs{};
    for (int i = 0; i < body::motions<Dim>; ++i)
      dofs[static_cast<std::size_t>(i)] = s.dofs.body_dof(static_cast<Index>(b), i);
    s.assembler.add_block(dofs, mass_of_body(inertia, s.model.rigid[b], state.rigid[b], b));
  }
  mass = s.builder.finish();
  solve::Evaluation evaluation;
  s.predict_about(state, 1.0, true, evaluation);
  if (!evaluation.ok) return evaluation.message;
  stiffness = s.builder.finish();
  return {};
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::motion_by(const State& about,
                                            const Eigen::VectorXd& unknowns) const {
  return impl_->motion_of_all(impl_->positions(about.u), about, unknowns);
}

template <int Dim>
Vibrations BasicSystem<Dim>::vibrations(const State& state, int count, la::LinearSolver& solver) {
  Impl& s = *impl_;
  Vibrations out;
  la::SparseMatrix stiffness, mass;
  out.failure = vibration_matrices(state, stiffness, mass);
  if (!out.failure.empty()) return out;
  const std::vector<Vec<Dim>> x = s.positions(state.u);
  const la::Eigenpairs pairs = la::smallest_eigenpairs(stiffness, mass, count, solver);
  out.failure = pairs.failure;
  out.omega_squared = pairs.values;
  out.residual = pairs.residual;
  out.missing = pairs.missing;
  const Eigen::MatrixXd r = rigid_motions<Dim>(s.dofs, s.assembler, x, state, mass.n);
  out.participation.setZero(pairs.values.size(), 6);
  for (const auto& [column, place] : places_in_space(s.model)) {
    const Eigen::VectorXd motion = r.col(column);
    const Eigen::VectorXd momentum = la::multiply(mass, motion);
    out.participation.col(place) = pairs.vectors.transpose() * momentum;
    out.moving_mass[place] = motion.dot(momentum);
  }
  out.vectors = pairs.vectors;
  out.motions.resize(s.dofs.dofs(), pairs.values.size());
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i)
    out.motions.col(i) = s.motion_of_all(x, state, pairs.vectors.col(i));
  out.shapes = out.motions.topRows(state.u.size());
  return out;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::carried_along(const State& about, la::LinearSolver& solver,
                                                std::string& failure) {
  Impl& s = *impl_;
  const std::vector<Vec<Dim>> x = s.positions(about.u);
  solve::Evaluation evaluation;
  s.predict_about(about, 1.0, true, evaluation);
  if (!evaluation.ok) failure = evaluation.message;
  if (s.constraints.count() > 0) failure = "supports move, and contacts have multipliers";
  if (!failure.empty()) return {};
  s.assembler.set_configuration(x, about.rigid);
  Eigen::VectorXd rest = -s.assembler.gather(s.last.predicted);
  const la::FactorReport report = solver.factor(matrix(), pattern_version(), symmetry());
  if (report.status != la::SolveStatus::ok || solver.solve(rest) != la::SolveStatus::ok) {
    failure = "supports move, and something is free to move without inertia";
    return {};
  }
  Eigen::VectorXd all = s.prescribed_increment(about, x, 1.0);
  const Eigen::VectorXd free = s.motion_of_all(x, about, rest);
  return all + free;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::momenta_along(const Vibrations& modes, const State& about,
                                                const Eigen::VectorXd& w) {
  Impl& s = *impl_;
  const std::vector<Vec<Dim>> x = s.positions(about.u);
  s.assembler.set_configuration(x, about.rigid);
  const Eigen::VectorXd momentum =
      s.assembler.gather(BasicInertia<Dim>(s.model, false).multiply(w));
  return modes.vectors.topRows(momentum.size()).transpose() * momentum;
}

template Eigen::VectorXd BasicSystem<2>::Impl::motion_of_all(std::span<const Vec<2>>, const State&,
                                                             const Eigen::VectorXd&) const;
template Eigen::VectorXd BasicSystem<3>::Impl::motion_of_all(std::span<const Vec<3>>, const State3&,
                                                             const Eigen::VectorXd&) const;
template void BasicSystem<2>::Impl::predict_about(const State&, double, bool, solve::Evaluation&);
template void BasicSystem<3>::Impl::predict_about(const State3&, double, bool, solve::Evaluation&);
template Eigen::VectorXd BasicSystem<2>::carried_along(const State&, la::LinearSolver&,
                                                       std::string&);
template Eigen::VectorXd BasicSystem<3>::carried_along(const State3&, la::LinearSolver&,
                                                       std::string&);
template Eigen::VectorXd BasicSystem<2>::momenta_along(const Vibrations&, const State&,
                                                       const Eigen::VectorXd&);
template Eigen::VectorXd BasicSystem<3>::momenta_along(const Vibrations&, const State3&,
                                                       const Eigen::VectorXd&);
template std::string BasicSystem<2>::vibration_matrices(const State&, la::SparseMatrix&,
                                                        la::SparseMatrix&);
template std::string BasicSystem<3>::vibration_matrices(const State3&, la::SparseMatrix&,
                                                        la::SparseMatrix&);
template Eigen::VectorXd BasicSystem<2>::motion_by(const State&, const Eigen::VectorXd&) const;
template Eigen::VectorXd BasicSystem<3>::motion_by(const State3&, const Eigen::VectorXd&) const;
template Vibrations BasicSystem<2>::vibrations(const State&, int, la::LinearSolver&);
template Vibrations BasicSystem<3>::vibrations(const State&, int, la::LinearSolver&);

}  // namespace osculate::model
