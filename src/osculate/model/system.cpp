#include "osculate/model/system.hpp"

#include <omp.h>

#include <algorithm>

#include "osculate/model/assembler.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::model {
namespace {

constexpr std::size_t tile = 256;  ///< cells computed in parallel before they are added in order

std::vector<bool> used_nodes(const Model& model) {
  std::vector<bool> used(model.reference.size(), false);
  for (const BulkSection& section : model.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = model.mesh.blocks[static_cast<std::size_t>(ref.block)];
      const int n = cell::info(block.type).nodes;
      for (int k = 0; k < n; ++k) used[static_cast<std::size_t>(block.cell(ref.cell)[k])] = true;
    }
  return used;
}

struct CellJob {
  const BulkSection* section;
  mesh::CellRef cell;
};

std::vector<CellJob> cell_jobs(const Model& model) {
  std::vector<CellJob> jobs;
  for (const BulkSection& section : model.sections)
    for (const mesh::CellRef& cell : section.cells) jobs.push_back({&section, cell});
  return jobs;
}

std::vector<Index> bodies_by_node(const Model& model) {
  return model.body_of_node.empty() ? std::vector<Index>(model.reference.size(), -1)
                                    : model.body_of_node;
}

bool needs_unsymmetric(const Model& model) {
  for (const ContactPair& pair : model.pairs) {
    const pairing::PairDefinition<2>& d = pair.definition;
    if (d.friction || (d.weight == pairing::Weight::current_area && d.tangent.consistent))
      return true;
  }
  for (const Step& step : model.steps)
    if (!step.pressure.empty()) return true;
  return false;
}

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (hash ^ value) * 1099511628211ull;  // FNV-1a
}

}  // namespace

struct System::Impl {
  const Model& model;
  int threads;
  DofSpace dofs;
  la::MatrixBuilder builder;
  Assembler assembler;
  std::vector<CellJob> jobs;
  std::vector<BulkBlock> blocks;
  std::vector<pairing::PairEvaluation<2>> contact;
  Forces forces;
  Eigen::VectorXd predicted;     ///< K du_prescribed on primary dofs
  Eigen::VectorXd branch_shift;  ///< force of the linearised branches minus the true force
  bool branched = false;
  Step step;
  std::array<bool, 4> enabled{true, true, true, true};
  la::Symmetry symmetry;
  std::vector<double> path_values;
  std::vector<Dof> path_dofs;

  Impl(const Model& m, int thread_count)
      : model(m),
        threads(std::max(1, thread_count)),
        dofs(static_cast<Index>(m.reference.size()), bodies_by_node(m),
             static_cast<Index>(m.rigid.size()), m.equations, used_nodes(m)),
        builder(dofs.unknowns()),
        assembler(dofs, builder),
        jobs(cell_jobs(m)),
        blocks(std::min(tile, jobs.size())),
        contact(m.pairs.size()),
        symmetry(needs_unsymmetric(m) ? la::Symmetry::unsymmetric : la::Symmetry::indefinite) {
    assembler.set_prescribed(std::vector<bool>(static_cast<std::size_t>(dofs.unknowns()), false));
    reserve_bulk_pattern();
  }

  /// Contact entries enter the pattern when they first appear and then stay.
  void reserve_bulk_pattern();

  [[nodiscard]] bool on(Term term) const { return enabled[static_cast<std::size_t>(term)]; }

  void clear(bool with_tangent) {
    const Eigen::Index n = dofs.dofs();
    forces.internal.setZero(n);
    forces.contact.setZero(n);
    forces.external.setZero(n);
    predicted.setZero(n);
    branch_shift.setZero(n);
    branched = false;
    if (with_tangent) builder.clear();
  }

  [[nodiscard]] double current_value(const State& s, Dof dof) const {
    if (dof < 2 * dofs.nodes()) return s.u[dof];
    const Dof local = dof - 2 * dofs.nodes();
    const body::RigidMotion& motion = s.rigid[static_cast<std::size_t>(local / 3)];
    return local % 3 == 2 ? motion.angle : motion.translation[local % 3];
  }

  [[nodiscard]] double equation_value(const Equation& equation, double fraction) const {
    return equation.value *
           (step.equation_start + (step.equation_end - step.equation_start) * fraction);
  }

  /// Increment of every primary dof that follows from prescriptions alone (unknowns fixed).
  [[nodiscard]] Eigen::VectorXd prescribed_increment(const State& s, std::span<const Vec2> x,
                                                     double fraction) const {
    Eigen::VectorXd inc = Eigen::VectorXd::Zero(dofs.dofs());
    for (const PrescribedDof& p : step.prescribed)
      inc[p.dof] = p.ramp.value(fraction) - current_value(s, p.dof);
    for (Index node = 0; node < dofs.nodes(); ++node) {
      const Index b = dofs.body_of(node);
      if (b < 0) continue;
      const auto j = body::motion_gradient(s.rigid[static_cast<std::size_t>(b)],
                                           x[static_cast<std::size_t>(node)]);
      inc.segment<2>(2 * node) = j * inc.segment<3>(dofs.body_dof(b, 0));
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

  template <class Block>
  void add_predicted(std::span<const Dof> block_dofs, const Block& k, const Eigen::VectorXd* inc) {
    if (!inc) return;
    for (std::size_t j = 0; j < block_dofs.size(); ++j) {
      const double du = (*inc)[block_dofs[j]];
      if (du == 0.0) continue;
      for (std::size_t i = 0; i < block_dofs.size(); ++i)
        predicted[block_dofs[i]] +=
            k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * du;
    }
  }

  bool add_bulk(const State& trial, bool with_tangent, const Eigen::VectorXd* inc,
                solve::Evaluation& out) {
    for (std::size_t start = 0; start < jobs.size(); start += tile) {
      const std::size_t count = std::min(tile, jobs.size() - start);
#pragma omp parallel for num_threads(threads) schedule(static)
      for (std::size_t i = 0; i < count; ++i) {
        const CellJob& job = jobs[start + i];
        evaluate_cell(model, *job.section, job.cell, trial.u, with_tangent, blocks[i]);
      }
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
        assembler.add_block(d, block.result.tangent);
        add_predicted(d, block.result.tangent, inc);
      }
    }
    return true;
  }

  void add_rank_one(std::span<const Dof> row_dofs, const pairing::BlockVector<2>& rows,
                    const std::vector<pairing::NodeGradient<2>>& gradient,
                    const Eigen::VectorXd* inc) {
    if (gradient.empty()) return;
    path_dofs.clear();
    path_values.clear();
    double along = 0;
    for (const pairing::NodeGradient<2>& g : gradient)
      for (int i = 0; i < 2; ++i) {
        path_dofs.push_back(dofs.node_dof(g.node, i));
        path_values.push_back(g.value[i]);
        if (inc) along += g.value[i] * (*inc)[path_dofs.back()];
      }
    assembler.add_outer(row_dofs, {rows.data(), row_dofs.size()}, path_dofs, path_values);
    for (std::size_t i = 0; i < row_dofs.size(); ++i)
      predicted[row_dofs[i]] += rows[static_cast<Eigen::Index>(i)] * along;
  }

  /// Terms of the nodes behind a contact point: one outer product per direction in space.
  void add_path(std::span<const Dof> row_dofs, const pairing::ContactBlock<2>& block,
                const Eigen::VectorXd* inc) {
    if (block.path().empty()) return;
    for (Eigen::Index c = 0; c < 2; ++c) {
      path_dofs.clear();
      path_values.clear();
      double along = 0;
      for (const pairing::NodeMatrix<2>& g : block.path())
        for (int i = 0; i < 2; ++i) {
          path_dofs.push_back(dofs.node_dof(g.node, i));
          path_values.push_back(g.value(c, i));
          if (inc) along += g.value(c, i) * (*inc)[path_dofs.back()];
        }
      const double* rows = block.path_rows.col(c).data();
      assembler.add_outer(row_dofs, {rows, row_dofs.size()}, path_dofs, path_values);
      for (std::size_t i = 0; i < row_dofs.size(); ++i) predicted[row_dofs[i]] += rows[i] * along;
    }
  }

  void add_contact_block(const pairing::ContactBlock<2>& block, bool with_tangent,
                         const Eigen::VectorXd* inc) {
    std::array<Dof, 2 * pairing::max_block_nodes<2>> all{};
    for (int k = 0; k < 2 * block.count; ++k)
      all[static_cast<std::size_t>(k)] =
          dofs.node_dof(block.nodes[static_cast<std::size_t>(k / 2)], k % 2);
    const std::span<const Dof> d(all.data(), static_cast<std::size_t>(2 * block.count));
    for (std::size_t k = 0; k < d.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      forces.contact[d[k]] += block.force[i];
      if (block.branched) branch_shift[d[k]] += block.branch_force[i] - block.force[i];
    }
    if (block.branched) branched = true;
    if (!with_tangent) return;
    assembler.add_block(d, block.tangent);
    add_predicted(d, block.tangent, inc);
    add_path(d, block, inc);
    add_rank_one(d, block.area_rows, block.area, inc);
  }

  void add_contact(const State& committed, const State& trial, std::span<const Vec2> x,
                   bool with_tangent, const Eigen::VectorXd* inc, solve::Evaluation& out) {
    out.counts = {};
    out.counts.signature = 14695981039346656037ull;
    for (std::size_t p = 0; p < model.pairs.size(); ++p) {
      const pairing::Assumed<2> assumed =
          inc ? pairing::committed_branches<2>(model.pairs[p].definition, committed.pairs[p], x)
          : p < trial.assumed.size() ? trial.assumed[p]
                                     : pairing::Assumed<2>{};
      pairing::evaluate<2>(model.pairs[p].definition, x, committed.pairs[p], with_tangent,
                           contact[p], assumed);
      for (const pairing::ContactBlock<2>& block : contact[p].blocks)
        if (block.active()) add_contact_block(block, with_tangent, inc);
      for (const pairing::PointResult<2>& point : contact[p].points) {
        mix(out.counts.signature, static_cast<std::uint64_t>(point.status));
        mix(out.counts.signature, point.shear_traction[0] > 0 ? 1u : 0u);
        if (point.status == contact::Status::open) ++out.counts.open;
        if (point.status == contact::Status::stick) ++out.counts.stick;
        if (point.status == contact::Status::slip) ++out.counts.slip;
      }
    }
  }

  void add_pressure(const State& trial, double fraction, bool with_tangent,
                    const Eigen::VectorXd* inc);

  void add_dead_loads(double fraction) {
    for (const DeadLoad& load : step.dead) {
      const double factor = load.ramp.value(fraction);
      for (const auto& entry : load.unit) forces.external[entry.first] += factor * entry.second;
    }
  }

  /// Second-order part of the rigid motion: forces on the nodes of a turning body.
  void add_rigid_geometry(const State& trial, std::span<const Vec2> x, const Eigen::VectorXd* inc) {
    const Eigen::VectorXd f = forces.internal + forces.contact - forces.external;
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      double stiffness = 0;
      for (const Index node : model.rigid[b].nodes)
        stiffness += f.segment<2>(2 * node).dot(
            body::rotation_curvature(trial.rigid[b], x[static_cast<std::size_t>(node)]));
      const Dof d = dofs.body_dof(static_cast<Index>(b), 2);
      const Index unknown = dofs.unknown_of(d);
      if (unknown >= 0 && !assembler.prescribed(unknown)) builder.add(unknown, unknown, stiffness);
      if (inc) predicted[d] += stiffness * (*inc)[d];
    }
  }

  void assemble(const State& committed, const State& trial, double fraction, bool with_tangent,
                bool predict, solve::Evaluation& out) {
    out.ok = true;
    out.message.clear();
    clear(with_tangent);
    std::vector<Vec2> x(model.reference.size());
    for (std::size_t n = 0; n < x.size(); ++n)
      x[n] = model.reference[n] + trial.u.segment<2>(2 * static_cast<Eigen::Index>(n));
    assembler.set_configuration(x, trial.rigid);
    Eigen::VectorXd inc;
    if (predict) inc = prescribed_increment(trial, x, fraction);
    const Eigen::VectorXd* increment = predict ? &inc : nullptr;
    if (on(Term::bulk) && !add_bulk(trial, with_tangent, increment, out)) return;
    if (on(Term::contact)) add_contact(committed, trial, x, with_tangent, increment, out);
    if (on(Term::pressure)) add_pressure(trial, fraction, with_tangent, increment);
    add_dead_loads(fraction);
    if (with_tangent && on(Term::rigid)) add_rigid_geometry(trial, x, increment);
    if (with_tangent) assembler.add_prescribed_diagonal(1.0);
    const Eigen::VectorXd total = forces.internal + forces.contact - forces.external;
    out.residual = assembler.gather(predict ? Eigen::VectorXd(total + predicted) : total);
    out.branch_residual.resize(0);
    if (branched) out.branch_residual = out.residual + assembler.gather(branch_shift);
    out.force_scale =
        std::max({forces.internal.norm(), forces.contact.norm(), forces.external.norm()});
    if (predict) out.force_scale = std::max(out.force_scale, out.residual.norm());
  }
};

void System::Impl::reserve_bulk_pattern() {
  std::vector<Index> unknowns;
  for (const CellJob& job : jobs) {
    const mesh::Block& block = model.mesh.blocks[static_cast<std::size_t>(job.cell.block)];
    unknowns.clear();
    for (int k = 0; k < 2 * cell::info(block.type).nodes; ++k) {
      const Index unknown = dofs.unknown_of(dofs.node_dof(block.cell(job.cell.cell)[k / 2], k % 2));
      if (unknown >= 0) unknowns.push_back(unknown);
    }
    builder.reserve_block(unknowns);
  }
}

void System::Impl::add_pressure(const State& trial, double fraction, bool with_tangent,
                                const Eigen::VectorXd* inc) {
  for (const PressureLoad& load : step.pressure) {
    const double pressure = load.ramp.value(fraction);
    if (pressure == 0.0) continue;
    for (const PressureLoad::Edge& edge : load.edges) {
      const solid::Section& section =
          model.sections[static_cast<std::size_t>(edge.section)].section;
      BulkBlock block;
      pressure_block(model, section, edge.nodes, trial.u, pressure, block);
      const std::span<const Dof> d(block.dofs.data(), static_cast<std::size_t>(block.dof_count));
      for (int k = 0; k < block.dof_count; ++k)
        forces.external[d[static_cast<std::size_t>(k)]] += block.result.force[k];
      if (!with_tangent) continue;
      block.result.tangent *= -1.0;  // external force moves to the left-hand side
      assembler.add_block(d, block.result.tangent);
      add_predicted(d, block.result.tangent, inc);
    }
  }
}

System::System(const Model& model, int threads) : impl_(std::make_unique<Impl>(model, threads)) {}
System::~System() = default;

State System::initial_state() {
  State state;
  const Model& model = impl_->model;
  state.u = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(model.reference.size()));
  for (const RigidBody& body : model.rigid)
    state.rigid.push_back({body.reference, Vec2::Zero(), 0});
  for (const ContactPair& pair : model.pairs)
    state.pairs.push_back(pairing::initial_state<2>(pair.definition, model.reference));
  return state;
}

void System::begin_step(const Step& step, const State& committed) {
  impl_->step = step;
  std::vector<bool> flags(static_cast<std::size_t>(impl_->dofs.unknowns()), false);
  for (PrescribedDof& p : impl_->step.prescribed) {
    p.ramp.start = impl_->current_value(committed, p.dof);
    if (p.hold) {
      p.ramp.target = p.ramp.start;
      p.ramp.amplitude.clear();
    }
    const Index unknown = impl_->dofs.unknown_of(p.dof);
    if (unknown >= 0) flags[static_cast<std::size_t>(unknown)] = true;
  }
  impl_->assembler.set_prescribed(std::move(flags));
}

void System::predict(const State& committed, double fraction, solve::Evaluation& out) {
  impl_->assemble(committed, committed, fraction, true, true, out);
}

void System::evaluate(const State& committed, const State& trial, double fraction,
                      bool with_tangent, solve::Evaluation& out) {
  impl_->assemble(committed, trial, fraction, with_tangent, false, out);
}

State System::apply(const State& state, const Eigen::VectorXd& du, double fraction,
                    double factor) const {
  const DofSpace& dofs = impl_->dofs;
  State next = state;
  next.fraction = fraction;
  const auto add = [&](Dof dof, double value) {
    if (dof < 2 * dofs.nodes()) {
      next.u[dof] += value;
      return;
    }
    const Dof local = dof - 2 * dofs.nodes();
    body::RigidMotion& motion = next.rigid[static_cast<std::size_t>(local / 3)];
    (local % 3 == 2 ? motion.angle : motion.translation[local % 3]) += value;
  };
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (!impl_->assembler.prescribed(u)) add(dofs.dof_of_unknown(u), factor * du[u]);
  for (const PrescribedDof& p : impl_->step.prescribed)
    add(p.dof, p.ramp.value(fraction) - impl_->current_value(next, p.dof));
  for (Index node = 0; node < dofs.nodes(); ++node) {
    const Index b = dofs.body_of(node);
    if (b < 0) continue;
    const Vec2& material = impl_->model.reference[static_cast<std::size_t>(node)];
    next.u.segment<2>(2 * node) =
        next.rigid[static_cast<std::size_t>(b)].position(material) - material;
  }
  for (const Equation& equation : dofs.equations()) {
    double rest = impl_->equation_value(equation, fraction);
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      rest -= equation.terms[t].factor * impl_->current_value(next, equation.terms[t].dof);
    const Equation::Term& lead = equation.terms.front();
    add(lead.dof, rest / lead.factor - impl_->current_value(next, lead.dof));
  }
  return next;
}

State System::remember(const State& trial) const {
  State state = trial;
  state.assumed.clear();
  for (const pairing::PairEvaluation<2>& e : impl_->contact)
    state.assumed.push_back(pairing::evaluated_branches(e));
  return state;
}

State System::commit(const State& trial, double fraction) const {
  State state = trial;
  state.fraction = fraction;
  state.assumed.clear();
  for (std::size_t p = 0; p < impl_->contact.size(); ++p)
    state.pairs[p] = pairing::commit(impl_->contact[p]);
  return state;
}

const la::SparseMatrix& System::matrix() { return impl_->builder.finish(); }
std::uint64_t System::pattern_version() const { return impl_->builder.pattern_version(); }
la::Symmetry System::symmetry() const { return impl_->symmetry; }
const DofSpace& System::dofs() const { return impl_->dofs; }
const Forces& System::forces() const { return impl_->forces; }
const std::vector<pairing::PairEvaluation<2>>& System::contact() const { return impl_->contact; }

std::vector<Vec2> System::positions(const State& state) const {
  std::vector<Vec2> x(impl_->model.reference.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = impl_->model.reference[n] + state.u.segment<2>(2 * static_cast<Eigen::Index>(n));
  return x;
}

bool System::prescribed(Index unknown) const { return impl_->assembler.prescribed(unknown); }
void System::enable(Term term, bool on) { impl_->enabled[static_cast<std::size_t>(term)] = on; }

}  // namespace osculate::model
