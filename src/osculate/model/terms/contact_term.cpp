#include "osculate/model/terms/contact_term.hpp"

#include "osculate/model/stopwatch.hpp"

namespace osculate::model {
namespace {

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (hash ^ value) * 1099511628211ull;  // FNV-1a
}

template <int Dim>
void sign_point(const pairing::PointResult<Dim>& point, std::uint64_t& signature) {
  mix(signature, static_cast<std::uint64_t>(point.status));
  if constexpr (Dim == 2) mix(signature, point.shear_traction[0] > 0 ? 1u : 0u);
}

template <int Dim>
void add_block(const pairing::ContactBlock<Dim>& block, Assembly<Dim>& to) {
  Evaluated<Dim>& into = to.into;
  const std::span<const Dof> d = to.rows_of(block);
  for (std::size_t k = 0; k < d.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    into.forces.contact[d[k]] += block.force[i];
    if (block.branched) into.branch_shift[d[k]] += block.branch_force[i] - block.force[i];
  }
  if (block.branched) into.branched = true;
  if (!to.with_tangent) return;
  if (block.has_tangent())
    to.add_stiffness(d, block.tangent,
                     block.without_master ? static_cast<std::size_t>(Dim * block.slave_count) : 0);
  const auto rows = static_cast<Eigen::Index>(d.size());
  if (!block.path().empty()) {  // of the nodes behind a contact point
    to.begin_path();
    for (const pairing::NodeMatrix<Dim>& g : block.path()) to.add_vectors_to_path(g.node, g.value);
    to.add_outer(d, block.path_rows.topRows(rows));
  }
  if (block.area.empty()) return;
  to.begin_path();
  for (const pairing::NodeGradient<Dim>& g : block.area) to.add_to_path(g.node, g.value);
  to.add_outer(d, block.area_rows.head(rows));
}

}  // namespace

template <int Dim>
void ContactTerm<Dim>::add(const State& committed, const Trial& trial, double fraction,
                           double duration, std::span<const Vec<Dim>> x, bool near,
                           const ConstraintTerm<Dim>& constraints, Assembly<Dim>& to,
                           solve::Evaluation& out) {
  std::vector<pairing::PairEvaluation<Dim>>& contact = to.into.contact;
  pairing::Workers here = workers;
  if (out.led) here.seen = {};  // what is prescribed moves forces of all nodes by the tangent
  out.counts = {};
  out.counts.signature = 14695981039346656037ull;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    const Stopwatch watch;
    pairing::ActiveSet<Dim> active_set =
        to.inc ? pairing::committed_active_set<Dim>(pair, committed.pairs[p], x, friction)
        : p < trial.active_set.size() ? trial.active_set[p]
                                      : pairing::ActiveSet<Dim>{};
    active_set.duration = duration;
    active_set.near = near;
    active_set.relief = relief(pair, fraction);
    const bool has_multipliers = p < trial.state.multipliers.size();
    double adding = 0;
    pairing::evaluate<Dim>(
        pair, x, committed.pairs[p], to.with_tangent, contact[p], active_set,
        has_multipliers ? &trial.state.multipliers[p] : nullptr,
        [&](std::span<const pairing::ContactBlock<Dim>> blocks) {
          const Stopwatch of_blocks;
          for (const pairing::ContactBlock<Dim>& block : blocks)
            if (block.active()) add_block(block, to);
          adding += of_blocks.seconds();
        },
        here);
    seconds += watch.seconds() - adding;
    constraints.add(p, to);
    for (const pairing::PointResult<Dim>& point : contact[p].points) {
      sign_point(point, out.counts.signature);
      count_point(pair, point, out.counts);
    }
  }
}

template <int Dim>
void ContactTerm<Dim>::look_far(const State& trial, std::span<const Vec<Dim>> x,
                                Evaluated<Dim>& last) {
  const Stopwatch watch;
  for (std::size_t p = 0; p < last.contact.size(); ++p)
    pairing::look_far<Dim>(model.pairs[p].definition, x, trial.pairs[p], last.contact[p], workers);
  seconds += watch.seconds();
}

template <int Dim>
ContactStates ContactTerm<Dim>::states(const Evaluated<Dim>& last) const {
  ContactStates states;
  for (std::size_t p = 0; p < last.contact.size(); ++p) {
    states.emplace_back();
    for (const pairing::PointResult<Dim>& point : last.contact[p].points) {
      PointCourse course{point_state(model.pairs[p].definition, point)};
      course.back = Dim == 2 && course.state == PointState::slipping && point.shear_traction[0] < 0;
      course.in_reentrant_vertex =
          course.state == PointState::closed && point.status == contact::Status::stick;
      states.back().push_back(course);
    }
  }
  return states;
}

template struct ContactTerm<2>;
template struct ContactTerm<3>;

}  // namespace osculate::model
