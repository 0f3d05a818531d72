#include "osculate/model/system_impl.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

namespace osculate::model {
namespace {

constexpr std::size_t tile = 256;  ///< cells computed in parallel before they are added in order

/// A moment about axes fixed in space has no potential: its tangent is unsymmetric.
template <int Dim>
bool has_moment_in_space(const BasicModel<Dim>& model, const DeadLoad& load) {
  const auto first = Dim * static_cast<Dof>(model.reference.size());
  return Dim == 3 && std::any_of(load.unit.begin(), load.unit.end(), [&](const auto& entry) {
           return entry.first >= first && (entry.first - first) % body::motions<Dim> >= Dim;
         });
}

template <int Dim>
bool needs_unsymmetric(const BasicModel<Dim>& model) {
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    const pairing::PairDefinition<Dim>& d = pair.definition;
    if (pairing::is_tied(d)) continue;
    if (d.friction || pairing::by_mortar(d) ||
        (d.weight == pairing::Weight::current_area && d.tangent.consistent))
      return true;
  }
  bool has_mass = false;
  for (const BasicRigidBody<Dim>& body : model.rigid) has_mass = has_mass || body.mass > 0;
  for (const Step& step : model.steps) {
    if (!step.pressure.empty()) return true;
    if (Dim == 3 && step.dynamics && has_mass) return true;  // moments of inertia
    for (const DeadLoad& load : step.dead)
      if (has_moment_in_space(model, load)) return true;
  }
  return false;
}

template <int Dim>
Index multiplier_unknowns(const BasicModel<Dim>& model) {
  Index sum = 0;
  for (const BasicContactPair<Dim>& pair : model.pairs)
    if (constrained(pair))
      sum += multipliers_per_point(pair) * static_cast<Index>(pair.definition.slave.points.size());
  return sum;
}

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (hash ^ value) * 1099511628211ull;  // FNV-1a
}

template <int Dim>
void sign_point(const pairing::PointResult<Dim>& point, std::uint64_t& signature) {
  mix(signature, static_cast<std::uint64_t>(point.status));
  if constexpr (Dim == 2) mix(signature, point.shear_traction[0] > 0 ? 1u : 0u);
}

}  // namespace

template <int Dim>
BasicSystem<Dim>::Impl::Impl(const BasicModel<Dim>& m, int thread_count)
    : model(m),
      threads(std::max(1, thread_count)),
      dofs(dof_space(m)),
      builder(dofs.unknowns() + multiplier_unknowns(m)),
      assembler(dofs, builder),
      contact(m.pairs.size()),
      symmetry(needs_unsymmetric(m) ? la::Symmetry::unsymmetric : la::Symmetry::indefinite) {
  unknowns = dofs.unknowns();
  touched.assign(model.pairs.size(), false);
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    first_multiplier.push_back(constrained(pair) ? unknowns : -1);
    if (constrained(pair))
      unknowns +=
          multipliers_per_point(pair) * static_cast<Index>(pair.definition.slave.points.size());
  }
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& cell, const CellMemory& m) {
    jobs.push_back({&section, cell, m});
    linear.add(section, cell_nodes(model.mesh, cell).type);
  });
  next_memory.resize(memory_size(model));
  blocks.resize(std::min(tile, jobs.size()));
  assembler.set_prescribed(std::vector<bool>(static_cast<std::size_t>(dofs.unknowns()), false));
}

template <int Dim>
void BasicSystem<Dim>::Impl::reserve_pattern() {
  if (pattern_reserved) return;
  pattern_reserved = true;
  // Contact entries enter the pattern when they first appear and then stay.
  std::vector<Index> of_cell;
  for (const CellJob& job : jobs) {
    of_cell.clear();
    for (const Index node : cell_nodes(model.mesh, job.cell).nodes)
      for (int i = 0; i < Dim; ++i) {
        const Index unknown = dofs.unknown_of(dofs.node_dof(node, i));
        if (unknown >= 0) of_cell.push_back(unknown);
      }
    builder.reserve_block(of_cell);
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::clear(bool with_tangent) {
  const Eigen::Index n = dofs.dofs();
  forces.internal.setZero(n);
  forces.contact.setZero(n);
  forces.external.setZero(n);
  forces.inertia.resize(0);
  predicted.setZero(n);
  branch_shift.setZero(n);
  constraint.setZero(unknowns - dofs.unknowns());
  branch_constraint.setZero(unknowns - dofs.unknowns());
  branched = false;
  if (!with_tangent) return;
  reserve_pattern();
  builder.clear();
}

template <int Dim>
std::vector<Vec<Dim>> BasicSystem<Dim>::Impl::positions(const Eigen::VectorXd& u) const {
  std::vector<Vec<Dim>> x(model.reference.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = model.reference[n] + u.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  return x;
}

template <int Dim>
ContactStates BasicSystem<Dim>::Impl::contact_states() const {
  ContactStates states;
  for (std::size_t p = 0; p < contact.size(); ++p) {
    states.emplace_back();
    for (const pairing::PointResult<Dim>& point : contact[p].points) {
      PointCourse course{point_state(model.pairs[p].definition, point)};
      course.back = Dim == 2 && course.state == PointState::slipping && point.shear_traction[0] < 0;
      course.in_reentrant_vertex =
          course.state == PointState::closed && point.status == contact::Status::stick;
      states.back().push_back(course);
    }
  }
  return states;
}

template <int Dim>
double BasicSystem<Dim>::Impl::current_value(const State& s, Dof dof) const {
  const Dof local = dof - Dim * dofs.nodes();
  if (local < 0) return s.u[dof];
  return s.rigid[static_cast<std::size_t>(local / body::motions<Dim>)].component(
      local % body::motions<Dim>);
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_to(State& s, Dof dof, double value) const {
  const Dof local = dof - Dim * dofs.nodes();
  if (local < 0)
    s.u[dof] += value;
  else
    s.rigid[static_cast<std::size_t>(local / body::motions<Dim>)].component(
        local % body::motions<Dim>) += value;
}

template <int Dim>
double BasicSystem<Dim>::Impl::equation_value(const Equation& equation, double fraction) const {
  return equation.value *
         (step.equation_start + (step.equation_end - step.equation_start) * fraction);
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::prescribed_increment(const State& s,
                                                             std::span<const Vec<Dim>> x,
                                                             double fraction) const {
  Eigen::VectorXd inc = Eigen::VectorXd::Zero(dofs.dofs());
  for (const PrescribedDof& p : step.prescribed)
    inc[p.dof] = p.ramp.value(fraction) - current_value(s, p.dof);
  for (Index node = 0; node < dofs.nodes(); ++node) {
    const Index b = dofs.body_of(node);
    if (b < 0) continue;
    const Mat<Dim, body::motions<Dim>> j = body::motion_gradient(
        s.rigid[static_cast<std::size_t>(b)], x[static_cast<std::size_t>(node)]);
    inc.segment<Dim>(Dim * node) = j * inc.segment<body::motions<Dim>>(dofs.body_dof(b, 0));
  }
  for (const Equation& equation : dofs.equations()) {
    double rest = equation_value(equation, fraction);
    for (std::size_t t = 1; t < equation.terms.size(); ++t) {
      const Dof d = equation.terms[t].dof;
      rest -= equation.terms[t].factor * (current_value(s, d) + inc[d]);
    }
    const Equation::Term& lead = equation.terms.front();
    inc[lead.dof] = rest / lead.factor - current_value(s, lead.dof);
  }
  return inc;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::add_bulk(const State& committed, const State& trial, double duration,
                                      bool with_tangent, const Eigen::VectorXd* inc,
                                      solve::Evaluation& out) {
  for (std::size_t start = 0; start < jobs.size(); start += tile) {
    const std::size_t count = std::min(tile, jobs.size() - start);
    const Stopwatch watch;
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t i = 0; i < count; ++i) {
      evaluate_job(start + i, trial.u, committed.memory, next_memory, duration, with_tangent,
                   blocks[i]);
    }
    seconds.bulk += watch.seconds();
    for (std::size_t i = 0; i < count; ++i) {
      const BulkBlock& block = blocks[i];
      if (!block.ok) {
        out.ok = false;
        out.message = block.message;
        return false;
      }
      const std::span<const Dof> d(block.dofs.data(), static_cast<std::size_t>(block.dof_count));
      for (int k = 0; k < block.dof_count; ++k)
        forces.internal[d[static_cast<std::size_t>(k)]] += block.result.force[k];
      if (!with_tangent) continue;
      if (timed()) add_cell_inertia(start + i, blocks[i].result.tangent);
      add_stiffness(d, block.result.tangent, inc);
    }
  }
  return true;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_outer(std::span<const Dof> row_dofs, const double* rows,
                                       const Eigen::VectorXd* inc) {
  assembler.add_outer(row_dofs, {rows, row_dofs.size()}, path_dofs, path_values);
  if (!inc) return;
  double along = 0;
  for (std::size_t j = 0; j < path_dofs.size(); ++j) along += path_values[j] * (*inc)[path_dofs[j]];
  for (std::size_t i = 0; i < row_dofs.size(); ++i) predicted[row_dofs[i]] += rows[i] * along;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_rank_one(std::span<const Dof> row_dofs,
                                          const Eigen::VectorXd& rows,
                                          const std::vector<pairing::NodeGradient<Dim>>& gradient,
                                          const Eigen::VectorXd* inc) {
  if (gradient.empty()) return;
  path_dofs.clear();
  path_values.clear();
  for (const pairing::NodeGradient<Dim>& g : gradient)
    for (int i = 0; i < Dim; ++i) {
      path_dofs.push_back(dofs.node_dof(g.node, i));
      path_values.push_back(g.value[i]);
    }
  add_outer(row_dofs, rows.data(), inc);
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_path(std::span<const Dof> row_dofs,
                                      const pairing::ContactBlock<Dim>& block,
                                      const Eigen::VectorXd* inc) {
  if (block.path().empty()) return;
  for (Eigen::Index c = 0; c < Dim; ++c) {
    path_dofs.clear();
    path_values.clear();
    for (const pairing::NodeMatrix<Dim>& g : block.path())
      for (int i = 0; i < Dim; ++i) {
        path_dofs.push_back(dofs.node_dof(g.node, i));
        path_values.push_back(g.value(c, i));
      }
    add_outer(row_dofs, block.path_rows.col(c).data(), inc);
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_contact_block(const pairing::ContactBlock<Dim>& block,
                                               bool with_tangent, const Eigen::VectorXd* inc) {
  contact_dofs.clear();
  for (int k = 0; k < Dim * block.count; ++k)
    contact_dofs.push_back(dofs.node_dof(block.nodes[static_cast<std::size_t>(k / Dim)], k % Dim));
  const std::span<const Dof> d(contact_dofs);
  for (std::size_t k = 0; k < d.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    forces.contact[d[k]] += block.force[i];
    if (block.branched) branch_shift[d[k]] += block.branch_force[i] - block.force[i];
  }
  if (block.branched) branched = true;
  if (!with_tangent) return;
  if (block.tangent.size() > 0) add_stiffness(d, block.tangent, inc);
  add_path(d, block, inc);
  add_rank_one(d, block.area_rows, block.area, inc);
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_contact(const State& committed, const Trial& trial,
                                         double fraction, std::span<const Vec<Dim>> x,
                                         bool with_tangent, const Eigen::VectorXd* inc, bool near,
                                         solve::Evaluation& out) {
  const double duration = time_between(committed, fraction);
  out.counts = {};
  out.counts.signature = 14695981039346656037ull;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    const Stopwatch watch;
    pairing::ActiveSet<Dim> active_set =
        inc ? pairing::committed_active_set<Dim>(pair, committed.pairs[p], x, friction)
        : p < trial.active_set.size() ? trial.active_set[p]
                                      : pairing::ActiveSet<Dim>{};
    active_set.duration = duration;
    active_set.near = near;
    active_set.relief = relief(pair, fraction);
    const bool has_multipliers = p < trial.state.multipliers.size();
    pairing::evaluate<Dim>(pair, x, committed.pairs[p], with_tangent, contact[p], active_set,
                           has_multipliers ? &trial.state.multipliers[p] : nullptr);
    seconds.contact += watch.seconds();
    for (const pairing::ContactBlock<Dim>& block : contact[p].blocks)
      if (block.active()) add_contact_block(block, with_tangent, inc);
    add_constraints(p, with_tangent, inc);
    for (const pairing::PointResult<Dim>& point : contact[p].points) {
      sign_point(point, out.counts.signature);
      count_point(pair, point, out.counts);
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::look_far(const State& trial) {
  const Stopwatch watch;
  const std::vector<Vec<Dim>> x = positions(trial.u);
  for (std::size_t p = 0; p < contact.size(); ++p)
    pairing::look_far<Dim>(model.pairs[p].definition, x, trial.pairs[p], contact[p]);
  seconds.contact += watch.seconds();
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_pressure(const State& trial, double fraction, bool with_tangent,
                                          const Eigen::VectorXd* inc) {
  BulkBlock block;
  for (const PressureLoad& load : step.pressure) {
    const double pressure = load.ramp.value(fraction);
    if (pressure == 0.0) continue;
    for (const PressureLoad::Facet& facet : load.facets) {
      pressure_block(model, facet, trial.u, pressure, block);
      const std::span<const Dof> d(block.dofs.data(), static_cast<std::size_t>(block.dof_count));
      for (int k = 0; k < block.dof_count; ++k)
        forces.external[d[static_cast<std::size_t>(k)]] += block.result.force[k];
      if (!with_tangent) continue;
      block.result.tangent *= -force_factor();  // external force moves to the left-hand side
      add_stiffness(d, block.result.tangent, inc);
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_dead_loads(double fraction) {
  for (const DeadLoad& load : step.dead) {
    const double factor = load.ramp.value(fraction);
    for (const auto& entry : load.unit) forces.external[entry.first] += factor * entry.second;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::turn_moments(const State& trial, bool with_tangent,
                                          const Eigen::VectorXd* inc) {
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      const Vec3 moment = forces.external.segment<3>(first);
      if (moment.isZero(0)) continue;
      const Vec3& theta = trial.rigid[b].rotation;
      forces.external.segment<3>(first) = body::rotation_tangent(theta).transpose() * moment;
      const std::array<Dof, 3> d{first, first + 1, first + 2};
      if (with_tangent)
        add_stiffness(d, Mat<3, 3>(-force_factor() * body::moment_gradient(theta, moment)), inc);
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_rigid_geometry(const State& trial, std::span<const Vec<Dim>> x,
                                                const Eigen::VectorXd* inc) {
  constexpr int turns = body::rotations<Dim>;
  const Eigen::VectorXd f = total_force();
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    Mat<turns, turns> stiffness = Mat<turns, turns>::Zero();
    for (const Index node : model.rigid[b].nodes) {
      const Vec<Dim> force = f.segment<Dim>(Dim * node);
      if (force.isZero(0)) continue;
      stiffness +=
          body::rotation_curvature(trial.rigid[b], x[static_cast<std::size_t>(node)], force);
    }
    std::array<Dof, turns> d{};
    for (int i = 0; i < turns; ++i)
      d[static_cast<std::size_t>(i)] = dofs.body_dof(static_cast<Index>(b), Dim + i);
    add_stiffness(d, stiffness, inc);
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::assemble(const State& committed, const Trial& trial, double fraction,
                                      bool with_tangent, Pass pass, solve::Evaluation& out) {
  const Stopwatch watch;
  const double elsewhere = seconds.bulk + seconds.contact;
  assemble_terms(committed, trial, fraction, with_tangent, pass, out);
  seconds.assembly += watch.seconds() - (seconds.bulk + seconds.contact - elsewhere);
}

/// A correction by a tangent without digits may leave forces that are small beside those of the
/// place it leads to.
template <int Dim>
bool BasicSystem<Dim>::Impl::flies_apart(const State& committed, const State& trial,
                                         solve::Evaluation& out) const {
  constexpr double farthest = 1e4;
  if (jobs.empty() || !(extent > 0) || trial.u.size() != committed.u.size()) return false;
  const double way = (trial.u - committed.u).template lpNorm<Eigen::Infinity>() / extent;
  if (way <= farthest) return false;
  out.ok = false;
  out.apart = true;
  out.message = fmt::format("nodes move by {:.0e} times the size of the model", way);
  return true;
}

template <int Dim>
void BasicSystem<Dim>::Impl::assemble_terms(const State& committed, const Trial& trial,
                                            double fraction, bool with_tangent, Pass pass,
                                            solve::Evaluation& out) {
  const State& now = trial.state;
  out.ok = true;
  out.apart = false;
  out.message.clear();
  clear(with_tangent);
  const std::vector<Vec<Dim>> x = positions(now.u);
  if (motion) begin_increment(committed, fraction, time_between(committed, fraction));
  if (motion && !motion->failure.empty()) {
    out.ok = false;
    out.message = motion->failure;
    return;
  }
  if (flies_apart(committed, now, out)) return;
  assembler.set_configuration(x, now.rigid);
  Eigen::VectorXd inc;
  const bool predict = pass == Pass::predict;
  if (predict) {
    inc = prescribed_increment(now, x, fraction);
    carried =
        inc.head(Dim * static_cast<Eigen::Index>(x.size())).template lpNorm<Eigen::Infinity>();
  }
  const Eigen::VectorXd* increment = predict ? &inc : nullptr;
  // A state against itself: no time has passed since what its material points remember.
  const double duration = pass == Pass::whole ? 0.0 : time_between(committed, fraction);
  if (on(Term::bulk) && !add_bulk(committed, now, duration, with_tangent, increment, out)) return;
  if (on(Term::contact))
    add_contact(committed, trial, fraction, x, with_tangent, increment, pass == Pass::iterate, out);
  if (on(Term::pressure)) add_pressure(now, fraction, with_tangent, increment);
  add_dead_loads(fraction);
  add_gravity(fraction);
  if (timed()) add_inertia(now, with_tangent, increment);
  turn_moments(now, with_tangent && on(Term::rigid), increment);
  if (with_tangent && on(Term::rigid)) add_rigid_geometry(now, x, increment);
  if (with_tangent) assembler.add_prescribed_diagonal(1.0);
  if (with_tangent && resisted > 0) add_resistance(resisted);
  const Eigen::VectorXd total = total_force();
  out.residual = assembler.gather(predict ? Eigen::VectorXd(total + predicted) : total);
  out.branch_residual.resize(0);
  if (branched) out.branch_residual = out.residual + assembler.gather(branch_shift);
  if (constraint.size() > 0) {
    const auto append = [](Eigen::VectorXd& v, const Eigen::VectorXd& more) {
      v.conservativeResize(v.size() + more.size());
      v.tail(more.size()) = more;
    };
    append(out.residual, constraint);
    if (branched) append(out.branch_residual, branch_constraint);
  }
  out.saddle = constraint.size() > 0;
  out.force_scale =
      std::max({forces.internal.norm(), forces.contact.norm(), forces.external.norm()});
  if (timed()) out.force_scale = std::max(force_factor() * out.force_scale, forces.contact.norm());
  if (with_tangent && resistance.size() == 0) measure_resistance();
  out.round_off_in_time = round_off_in_time(x);
  out.round_off = round_off + out.round_off_in_time;
  out.loaded = forces.external.norm() > 0;
  if (pass == Pass::predict) out.force_scale = std::max(out.force_scale, out.residual.norm());
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
