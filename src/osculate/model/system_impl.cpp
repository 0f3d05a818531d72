#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "osculate/la/halo.hpp"
#include "osculate/model/body_changes.hpp"
#include "osculate/model/system_explicit.hpp"
#include "osculate/model/temperatures.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::model {
namespace {

/// A pair that holds its two sides together throughout.
template <int Dim>
bool ties_alone(const BasicModel<Dim>& model, const BasicContactPair<Dim>& pair) {
  return pairing::is_tied(pair.definition) && model.pair_changes.empty();
}

/// A moment about axes fixed in space has no potential: its tangent is unsymmetric.
template <int Dim>
bool has_moment_in_space(const BasicModel<Dim>& model, const DeadLoad& load) {
  const auto first = Dim * static_cast<Dof>(model.reference.size());
  return Dim == 3 && std::any_of(load.unit.begin(), load.unit.end(), [&](const auto& entry) {
           return entry.first >= first && (entry.first - first) % body::motions<Dim> >= Dim;
         });
}

/// Friction, inertia of bodies that turn, moments about fixed axes: what is not symmetric of their
/// tangents is as large as the rest.
template <int Dim>
bool is_unsymmetric(const BasicModel<Dim>& model) {
  const auto rubs = [](const auto& has) { return static_cast<bool>(has.friction); };
  if (std::ranges::any_of(model.pair_changes, rubs)) return true;
  for (const BasicContactPair<Dim>& pair : model.pairs)
    if (pair.definition.friction && !ties_alone(model, pair)) return true;
  bool has_mass = false;
  for (const BasicRigidBody<Dim>& body : model.rigid) has_mass = has_mass || body.mass > 0;
  for (const Step& step : model.steps) {
    if (Dim == 3 && step.dynamics && has_mass) return true;  // moments of inertia
    for (const DeadLoad& load : step.dead)
      if (has_moment_in_space(model, load)) return true;
  }
  return false;
}

/// Pressures that follow a surface: what is not symmetric is of its rim. Contact without friction
/// whose points carry an area that moves, or by mortar, whose forces are not the derivative of its
/// gaps to the last term: what is not symmetric is in the ratio of pressure to stiffness.
template <int Dim>
bool is_nearly_symmetric(const BasicModel<Dim>& model) {
  const auto presses = [](const Step& step) { return !step.pressure.empty(); };
  const auto has_area = [&](const BasicContactPair<Dim>& pair) {
    const pairing::PairDefinition<Dim>& d = pair.definition;
    return (pairing::by_mortar(d) ||
            (d.weight == pairing::Weight::current_area && d.tangent.consistent)) &&
           !ties_alone(model, pair);
  };
  return std::ranges::any_of(model.steps, presses) || std::ranges::any_of(model.pairs, has_area);
}

}  // namespace

template <int Dim>
bool needs_unsymmetric(const BasicModel<Dim>& model) {
  return is_unsymmetric(model) || is_nearly_symmetric(model);
}

template bool needs_unsymmetric(const Model&);
template bool needs_unsymmetric(const Model3&);

template <int Dim>
BasicSystem<Dim>::Impl::Impl(const BasicModel<Dim>& m, int threads, const core::Ranks* of)
    : model(m),
      dofs(dof_space(m)),
      bulk(m, dofs, std::max(1, threads)),
      contact{m},
      constraints(m, dofs.unknowns()),
      springs{m},
      loads{m},
      builder(constraints.end),
      assembler(dofs, builder),
      symmetry(needs_unsymmetric(m) ? la::Symmetry::unsymmetric : la::Symmetry::indefinite),
      nearly_symmetric(symmetry == la::Symmetry::unsymmetric && constraints.count() == 0 &&
                       !is_unsymmetric(m)),
      ranks(of) {
  contact.workers.crew = &bulk.crew;
  last.contact.resize(model.pairs.size());
  last.memory.resize(memory_size(model));
  touched.assign(model.pairs.size(), false);
  assembler.set_prescribed(std::vector<bool>(static_cast<std::size_t>(dofs.unknowns()), false));
}

namespace {

/// Places that are there, then those of rows of other processes that are not; `rows` are owned
/// here.
std::vector<la::MatrixPlace> places_of_all(const core::Ranks& ranks, const std::vector<bool>& rows,
                                           std::vector<la::MatrixPlace> places) {
  std::vector<double> own;
  std::set<std::pair<Index, Index>> others;
  for (const la::MatrixPlace& place : places)
    if (rows[static_cast<std::size_t>(place.row)])
      own.insert(own.end(), {static_cast<double>(place.row), static_cast<double>(place.column)});
    else
      others.emplace(place.row, place.column);
  const auto count = static_cast<std::size_t>(ranks.count());
  std::vector<std::vector<double>> to(count, own);
  to[static_cast<std::size_t>(ranks.rank())].clear();
  const std::vector<double> taken = la::exchanged(ranks, to);
  for (std::size_t i = 0; i < taken.size(); i += 2) {
    const la::MatrixPlace place{static_cast<Index>(taken[i]), static_cast<Index>(taken[i + 1])};
    if (others.emplace(place.row, place.column).second) places.push_back(place);
  }
  return places;
}

}  // namespace

template <int Dim>
bool BasicSystem<Dim>::Impl::share(std::span<const pairing::PairState<Dim>> contact_now) {
  if (!ranks) return false;
  std::optional<std::vector<int>> next;
  if (ranks->rank() == 0)
    next = bulk.ranks ? better_owners<Dim>(model, contact_now, owner, ranks->count(), unevenness)
                      : node_owners<Dim>(model, contact_now, ranks->count());
  if (!ranks->any(next.has_value())) return false;
  owner = next ? std::move(*next) : std::vector<int>(model.reference.size());
  ranks->spread(owner, 0);
  const std::vector<la::MatrixPlace> grown = grown_by_all();
  bulk.ranks = ranks;
  bulk.shares = shares_of(model, dofs, constraints.count(), owner, ranks->rank(), ranks->count());
  contact.workers = {&bulk.crew, ranks, bulk.shares.seen};
  begin_matrix(grown);
  return true;
}

template <int Dim>
void BasicSystem<Dim>::Impl::share_no_more() {
  if (!bulk.ranks) return;
  const std::vector<la::MatrixPlace> grown = grown_by_all();
  bulk.ranks = nullptr;
  contact.workers = {};
  contact.workers.crew = &bulk.crew;
  begin_matrix(grown);
}

template <int Dim>
void BasicSystem<Dim>::Impl::begin_matrix(std::span<const la::MatrixPlace> grown) {
  builder = bulk.ranks ? la::MatrixBuilder(constraints.end, ranks, bulk.shares.rows)
                       : la::MatrixBuilder(constraints.end);
  builder.grow_by(grown);
}

template <int Dim>
void BasicSystem<Dim>::Impl::prescribe(std::vector<bool> unknowns) {
  if (unknowns == assembler.prescribed()) return;
  const std::vector<la::MatrixPlace> grown = grown_by_all();  // checkpoints add to what they had
  assembler.set_prescribed(std::move(unknowns));
  begin_matrix(grown);
}

template <int Dim>
std::vector<la::MatrixPlace> BasicSystem<Dim>::Impl::grown_by_all() {
  pattern_reserved = false;
  builder.finish();
  const std::vector<la::MatrixPlace>& here = builder.grown();  // a checkpoint may know them
  return bulk.ranks ? places_of_all(*ranks, bulk.shares.rows, here) : here;
}

template <int Dim>
void BasicSystem<Dim>::Impl::reserve_pattern() {
  if (pattern_reserved) return;
  pattern_reserved = true;
  // Contact entries enter the pattern when they first appear and then stay.
  bulk.reserve(dofs, assembler.prescribed(), builder);
}

template <int Dim>
std::vector<Vec<Dim>> BasicSystem<Dim>::Impl::positions(const Eigen::VectorXd& u) const {
  std::vector<Vec<Dim>> x(model.reference.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = model.reference[n] + u.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  return x;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::dof_values(const State& s) const {
  Eigen::VectorXd q(dofs.dofs());
  q.head(s.u.size()) = s.u;
  for (std::size_t b = 0; b < s.rigid.size(); ++b)
    for (int i = 0; i < body::motions<Dim>; ++i)
      q[dofs.body_dof(static_cast<Index>(b), i)] = s.rigid[b].component(i);
  return q;
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
bool BasicSystem<Dim>::Impl::timed() const {
  return motion && motion->h > 0;
}

template <int Dim>
double BasicSystem<Dim>::Impl::force_factor() const {
  return timed() ? motion->factors.force : 1.0;
}

template <int Dim>
void BasicSystem<Dim>::Impl::begin_drivers() {
  motion.reset();
  explicit_motion.reset();
  if (!step.dynamics) return;
  motion = std::make_shared<Motion>(*this);
  if (step.dynamics->explicit_steps) explicit_motion = std::make_shared<Explicit>(*this);
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::total_force() const {
  if (timed()) return motion->balance();
  return last.forces.internal + last.forces.contact - last.forces.external;
}

template <int Dim>
double BasicSystem<Dim>::Impl::round_off_in_time(std::span<const Vec<Dim>> x) const {
  const double h = timed() ? motion->h : 0.0;
  const double of_mass = timed() ? motion->factors.mass * motion->size_of_mass : 0.0;
  double farthest = 0, springs = 0;
  for (const Vec<Dim>& p : x) farthest = std::max(farthest, p.norm());
  for (std::size_t p = 0; p < last.contact.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    if (!timed() && !pair.damping) continue;  // a penalty is not steep enough to show
    for (std::size_t i = 0; i < last.contact[p].points.size(); ++i) {
      const pairing::PointResult<Dim>& point = last.contact[p].points[i];
      if (point.status == contact::Status::open) continue;
      double slope = std::abs(contact::response(pair.normal, point.gap, true).d_traction) *
                     pairing::relative_stiffness(pair, i).normal;
      if (pair.damping) slope = contact::stiffest(*pair.damping, slope, h);
      springs += slope * slope * point.weight * point.weight;
    }
  }
  return 2 * std::numeric_limits<double>::epsilon() * farthest * (of_mass + std::sqrt(springs));
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
void BasicSystem<Dim>::Impl::assemble(const State& committed, const Trial& trial, double fraction,
                                      bool with_tangent, Pass pass, solve::Evaluation& out) {
  const Stopwatch watch;
  const double elsewhere = bulk.seconds + contact.seconds;
  assemble_terms(committed, trial, fraction, with_tangent, pass, out);
  if (bulk.ranks && out.ok) spread(out);
  assembly_seconds += watch.seconds() - (bulk.seconds + contact.seconds - elsewhere);
}

template <int Dim>
void BasicSystem<Dim>::Impl::spread(solve::Evaluation& out) const {
  const core::Ranks& all = *bulk.ranks;
  solve::StateCounts& counts = out.counts;
  std::array<double, 4> measures{out.force_scale, out.round_off, out.round_off_in_time,
                                 counts.friction_work};
  constexpr unsigned half = 32;
  std::array<int, 10> marks{counts.open,
                            counts.stick,
                            counts.slipping,
                            counts.closed,
                            static_cast<int>(counts.signature),
                            static_cast<int>(counts.signature >> half),
                            static_cast<int>(out.loaded),
                            static_cast<int>(out.led),
                            static_cast<int>(out.saddle),
                            static_cast<int>(out.branch_residual.size())};
  all.spread(measures, 0);
  all.spread(marks, 0);
  out.force_scale = measures[0];
  out.round_off = measures[1];
  out.round_off_in_time = measures[2];
  counts = {marks[0], marks[1], marks[2], marks[3], 0, measures[3]};
  counts.signature = static_cast<std::uint32_t>(marks[4]) |
                     std::uint64_t{static_cast<std::uint32_t>(marks[5])} << half;
  out.loaded = marks[6] != 0;
  out.led = marks[7] != 0;
  out.saddle = marks[8] != 0;
  out.branch_residual.conservativeResize(marks[9]);
  all.spread({out.residual.data(), static_cast<std::size_t>(out.residual.size())}, 0);
  all.spread({out.branch_residual.data(), static_cast<std::size_t>(marks[9])}, 0);
}

/// A correction by a tangent without digits may leave forces that are small beside those of the
/// place it leads to.
template <int Dim>
bool BasicSystem<Dim>::Impl::flies_apart(const State& committed, const State& trial,
                                         solve::Evaluation& out) const {
  constexpr double farthest = 1e4;
  const double extent = resistance.extent;
  if (bulk.jobs.empty() || !(extent > 0) || trial.u.size() != committed.u.size()) return false;
  const double way = (trial.u - committed.u).template lpNorm<Eigen::Infinity>() / extent;
  if (way <= farthest) return false;
  out.ok = false;
  out.apart = true;
  out.message = fmt::format("nodes move by {:.0e} times the size of the model", way);
  return true;
}

/// The first tangent is as a rule that of the bodies at rest, which `resistance` asks for.
template <int Dim>
bool BasicSystem<Dim>::Impl::add_bodies(const State& committed, const State& now, double duration,
                                        const CellInertia<Dim>* inertia, Assembly<Dim>& to,
                                        solve::Evaluation& out) {
  const bool measures =
      to.with_tangent && resistance.diagonal.size() == 0 && bulk.which == Cells::all;
  Eigen::VectorXd at_rest;
  if (measures && on(Term::bulk) && committed.memory.empty() && now.u.isZero(0))
    at_rest.setZero(dofs.dofs());
  bulk.diagonal = at_rest.size() > 0 ? &at_rest : nullptr;
  const bool added = !on(Term::bulk) || bulk.add(committed, now, duration, inertia, to, out);
  bulk.diagonal = nullptr;
  if (added && measures) resistance.measure(bulk, dofs, std::move(at_rest));
  return added;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_loads(const State& now, double fraction, bool with_tangent,
                                       Assembly<Dim>& to) {
  if (on(Term::pressure)) loads.add_following(step, now, fraction, places, to);
  if (places == LoadPlaces::state && with_tangent) loads.add_turning_pressure(step, fraction, to);
  loads.add_dead_loads(step, fraction, last.forces);
  loads.add_gravity(step, fraction, motion ? &motion->inertia : nullptr, last.forces);
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_turning(const State& now, std::span<const Vec<Dim>> x,
                                         bool with_tangent, Assembly<Dim>& to) {
  const bool of_bodies = with_tangent && on(Term::rigid);
  const SmallRotations small = with_stresses ? SmallRotations::turn : SmallRotations::linear;
  turn_moments(model, now, of_bodies, to, small);
  if (of_bodies) add_rigid_geometry<Dim>(model, now, x, total_force(), to, small);
}

template <int Dim>
void BasicSystem<Dim>::Impl::begin_tangent() {
  reserve_pattern();
  if (bulk.which != Cells::all)
    builder.clear(changing);
  else if (!on(Term::bulk))
    builder.clear();
}

template <int Dim>
void BasicSystem<Dim>::Impl::assemble_terms(const State& committed, const Trial& trial,
                                            double fraction, bool with_tangent, Pass pass,
                                            solve::Evaluation& out) {
  const State& now = trial.state;
  out.ok = true;
  out.apart = false;
  out.message.clear();
  last.clear(dofs.dofs(), constraints.count());
  if (with_tangent) begin_tangent();
  const std::vector<Vec<Dim>> x = positions(now.u);
  if (motion) motion->begin_increment(committed, fraction, time_between(committed, fraction));
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
    last.carried =
        inc.head(Dim * static_cast<Eigen::Index>(x.size())).template lpNorm<Eigen::Infinity>();
  }
  out.led = predict && !inc.isZero(0.0);
  Assembly<Dim> to = assembly(with_tangent, predict ? &inc : nullptr);
  const double length = time_between(committed, fraction);
  // A state against itself: no time has passed since what its material points remember.
  const double duration = pass == Pass::whole || step.at_once ? 0.0 : length;
  std::optional<CellInertia<Dim>> of_cells;
  if (timed()) of_cells.emplace(motion->cell_inertia());
  if (!model.body_changes.empty()) keep_memory(model, committed.memory, last.memory);
  warm(model, step.temperature, fraction, last.memory);
  if (!add_bodies(committed, now, duration, of_cells ? &*of_cells : nullptr, to, out)) return;
  if (with_stresses && with_tangent) {
    std::vector<double> memory = committed.memory;
    warm(model, step.temperature, fraction, memory);
    bulk.add_stresses({now.u, memory}, nullptr, to);
  }
  if (on(Term::bulk)) springs.add(now, x, to);
  if (on(Term::contact))
    contact.add(committed, trial, fraction, length, x, pass == Pass::iterate, constraints, to, out);
  if (with_tangent) constraints.hold(committed, dofs, assembler.prescribed());
  if (on(Term::rigid)) constraints.add_nodes(now, x, to);
  add_loads(now, fraction, with_tangent, to);
  if (timed()) motion->add_inertia(now, to);
  add_turning(now, x, with_tangent, to);
  if (with_tangent) {
    assembler.add_prescribed_diagonal(1.0);
    if (resistance.share > 0) resistance.add(resistance.share, assembler, builder);
  }
  report(x, predict, out);
}

template <int Dim>
void BasicSystem<Dim>::Impl::report(std::span<const Vec<Dim>> x, bool predict,
                                    solve::Evaluation& out) const {
  const Eigen::VectorXd total = total_force();
  out.residual = assembler.gather(predict ? Eigen::VectorXd(total + last.predicted) : total);
  out.branch_residual.resize(0);
  if (last.branched) out.branch_residual = out.residual + assembler.gather(last.branch_shift);
  if (constraints.count() > 0) {
    const auto append = [](Eigen::VectorXd& v, const Eigen::VectorXd& more) {
      v.conservativeResize(v.size() + more.size());
      v.tail(more.size()) = more;
    };
    append(out.residual, last.constraint);
    if (last.branched) append(out.branch_residual, last.branch_constraint);
  }
  out.saddle = constraints.count() > 0;
  const Forces& forces = last.forces;
  out.force_scale =
      std::max({forces.internal.norm(), forces.contact.norm(), forces.external.norm()});
  if (timed()) out.force_scale = std::max(force_factor() * out.force_scale, forces.contact.norm());
  out.round_off_in_time = round_off_in_time(x);
  out.round_off = resistance.round_off + out.round_off_in_time;
  out.loaded = forces.external.norm() > 0;
  if (predict) out.force_scale = std::max(out.force_scale, out.residual.norm());
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
