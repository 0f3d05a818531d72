#include "osculate/api/contact_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/core/error.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::api {
namespace {

/// Facet by facet: the right number of nodes, which exist and differ.
void check_nodes(std::span<const Index> list, std::size_t per, std::size_t nodes,
                 const char* name) {
  if (list.empty() || list.size() % per != 0)
    throw core::InputError(
        {}, fmt::format("{}: {} node numbers are no whole number of facets of {}", name,
                        list.size(), per));
  for (const Index node : list)
    if (node < 0 || static_cast<std::size_t>(node) >= nodes)
      throw core::InputError({}, fmt::format("{}: node {} does not exist", name, node));
  for (std::size_t f = 0; f < list.size(); f += per) {
    const std::span<const Index> facet = list.subspan(f, per);
    for (std::size_t k = 1; k < per; ++k)
      if (std::find(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(k), facet[k]) !=
          facet.begin() + static_cast<std::ptrdiff_t>(k))
        throw core::InputError(
            {}, fmt::format("{}: facet {} names node {} twice", name, f / per, facet[k]));
  }
}

pairing::Chain boundary_of(const FacetList& list, std::size_t nodes, const char* name) {
  if (list.nodes_per_facet < 2 || list.nodes_per_facet > cell::max_line_nodes)
    throw core::InputError({}, fmt::format("{}: nodes_per_facet must be 2 to {}, got {}", name,
                                           cell::max_line_nodes, list.nodes_per_facet));
  const auto per = static_cast<std::size_t>(list.nodes_per_facet);
  check_nodes(list.nodes, per, nodes, name);
  pairing::Chain chain;
  for (std::size_t f = 0; f < list.nodes.size(); f += per)
    chain.facets.push_back(pairing::lagrange_facet(list.nodes.subspan(f, per)));
  pairing::connect(chain);
  return chain;
}

pairing::FacetSurface boundary_of(const FacetList3& list, std::size_t nodes, const char* name) {
  if (cell::info(list.type).dimension != 2)
    throw core::InputError({}, fmt::format("{}: a facet is tri3, tri6, quad4, quad8 or quad9, not "
                                           "{}",
                                           name, cell::info(list.type).name));
  const auto per = static_cast<std::size_t>(cell::info(list.type).nodes);
  check_nodes(list.nodes, per, nodes, name);
  pairing::FacetSurface surface;
  for (std::size_t f = 0; f < list.nodes.size(); f += per)
    surface.facets.push_back(pairing::surface_facet(list.type, list.nodes.subspan(f, per)));
  pairing::connect(surface);
  return surface;
}

/// A text that says what is wrong with a law.
void check_laws(const ContactOptions& options) {
  const contact::NormalLaw normal =
      options.normal.value_or(contact::penalty(options.normal_penalty));
  std::string wrong = contact::fault(normal);
  if (wrong.empty() && options.friction) wrong = contact::fault(*options.friction);
  if (wrong.empty() && options.friction && contact::needs_duration(*options.friction))
    wrong = "friction by speed needs a time, which an evaluation does not have";
  if (wrong.empty() && options.damping) wrong = contact::fault(*options.damping);
  if (wrong.empty() && options.damping && contact::needs_duration(*options.damping))
    wrong = "viscous damping needs a time, which an evaluation does not have";
  if (wrong.empty() && options.damping && options.separation != pairing::Separation::allowed)
    wrong = "points that are held do not part: damping goes with separation allowed only";
  if (wrong.empty() && options.separation != pairing::Separation::allowed &&
      !contact::holds(normal))
    wrong = "this normal law lets go: separation goes with a penalty only";
  if (wrong.empty() && !(options.offset >= 0 && std::isfinite(options.offset)))
    wrong = fmt::format("offset must be >= 0, got {:g}", options.offset);
  if (wrong.empty() && !(options.tolerance >= 0))
    wrong = fmt::format("tolerance must be >= 0, got {:g}", options.tolerance);
  if (!wrong.empty()) throw core::InputError({}, wrong);
}

/// What goes with corrected or unknown tractions.
void check_enforcement(const ContactOptions& options) {
  using contact::Enforcement;
  if (options.enforcement == Enforcement::penalty) return;
  const char* wrong = nullptr;
  if (options.normal && !contact::augmentable(*options.normal))
    wrong =
        "a law that gives the pressure as a function of the gap is met by itself: use the penalty";
  else if (options.damping)
    wrong = "damping is a part of the spring that a penalty is";
  else if (options.separation == pairing::Separation::tied)
    wrong = "tied points are held by penalty only";
  const bool unknown = options.enforcement == Enforcement::lagrange_multiplier;
  if (unknown && options.sampling.rule != pairing::Sampling::Rule::nodes)
    wrong = "unknown tractions go with sampling at nodes only";
  else if (unknown && options.residual == contact::ResidualForm::full)
    wrong = "unknown tractions have the residual form surface only";
  else if (unknown && !options.tangent.consistent)
    wrong = "unknown tractions have the consistent tangent only";
  if (wrong) throw core::InputError({}, std::string("enforcement: ") + wrong);
}

void check_options(const ContactOptions& options) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  check_laws(options);
  check_enforcement(options);
  using Rule = pairing::Sampling::Rule;
  const pairing::Sampling& s = options.sampling;
  if (s.rule != Rule::nodes &&
      (s.points < (s.rule == Rule::gauss ? 1 : 2) || s.points > 20 || s.subdomains < 1))
    throw core::InputError({}, fmt::format("sampling needs 1 to 20 Gauss or 2 to 20 Lobatto points "
                                           "and subdomains >= 1, got {} and {}",
                                           s.points, s.subdomains));
  if (!positive(options.area.thickness))
    throw core::InputError(
        {}, fmt::format("area.thickness must be > 0, got {:g}", options.area.thickness));
}

template <int Dim>
void check_disjoint(const BasicFacetList<Dim>& master, const BasicFacetList<Dim>& slave) {
  const std::set<Index> nodes(master.nodes.begin(), master.nodes.end());
  for (const Index node : slave.nodes)
    if (nodes.contains(node))
      throw core::InputError({}, fmt::format("node {} is on master and slave", node));
}

template <int Dim>
std::vector<Vec<Dim>> points_of(std::span<const double> values) {
  if (values.size() % Dim != 0)
    throw core::InputError({}, fmt::format("{} coordinates are no {}", values.size(),
                                           Dim == 2 ? "pairs of x and y" : "triples of x, y, z"));
  std::vector<Vec<Dim>> x(values.size() / Dim);
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] = Eigen::Map<const Vec<Dim>>(values.data() + Dim * n);
    if (!x[n].allFinite())
      throw core::InputError({}, fmt::format("the coordinates of node {} are not finite", n));
  }
  return x;
}

template <int Dim>
void add_block(const pairing::ContactBlock<Dim>& block, bool with_tangent,
               BasicContactResult<Dim>& out) {
  const auto row_of = [&](int k) {
    return Dim * block.nodes[static_cast<std::size_t>(k / Dim)] + k % Dim;
  };
  for (int i = 0; i < Dim * block.count; ++i) {
    out.force[static_cast<std::size_t>(row_of(i))] += block.force[i];
    if (!with_tangent) continue;
    for (int j = 0; block.tangent.size() > 0 && j < Dim * block.count; ++j)
      out.tangent.push_back({row_of(i), row_of(j), block.tangent(i, j)});
    for (const pairing::NodeMatrix<Dim>& g : block.path())
      for (int d = 0; d < Dim; ++d)
        out.tangent.push_back(
            {row_of(i), Dim * g.node + d, block.path_rows.row(i).dot(g.value.col(d))});
    for (const pairing::NodeGradient<Dim>& g : block.area)
      for (int d = 0; d < Dim; ++d)
        out.tangent.push_back({row_of(i), Dim * g.node + d, block.area_rows[i] * g.value[d]});
  }
}

/// Value, rows and columns of the constraint of one point, whose first unknown is `first`.
template <int Dim>
void add_constraint(const pairing::ContactBlock<Dim>& block, Index first, Index count,
                    bool with_tangent, ContactConstraints& out) {
  const pairing::ConstraintBlock<Dim>& c = block.constraint;
  const auto at = [first](Index i) { return static_cast<std::size_t>(first + i); };
  out.value[at(0)] = c.normal;
  for (Index i = 1; i < count; ++i) out.value[at(i)] = c.shear[i - 1];
  if (!with_tangent) return;
  for (const pairing::NodeGradient<Dim>& g : c.normal_row)
    for (int d = 0; d < Dim; ++d) out.rows.push_back({first, Dim * g.node + d, g.value[d]});
  for (const pairing::NodeMatrix<Dim>& g : c.shear_row)
    for (int i = 0; i < Dim; ++i)
      for (int d = 0; d < Dim; ++d)
        out.rows.push_back({first + 1 + i, Dim * g.node + d, g.value(i, d)});
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j)
      if (c.own(i, j) != 0.0) out.own.push_back({first + i, first + j, c.own(i, j)});
  for (int k = 0; k < Dim * block.count; ++k)
    for (Index j = 0; j < count; ++j)
      out.columns.push_back({Dim * block.nodes[static_cast<std::size_t>(k / Dim)] + k % Dim,
                             first + j, c.columns(k, j)});
}

}  // namespace

template <int Dim>
struct BasicContactEvaluator<Dim>::Impl {
  pairing::PairDefinition<Dim> pair;
  pairing::PairState<Dim> committed;
  pairing::PairEvaluation<Dim> evaluation;
  std::size_t nodes = 0;

  [[nodiscard]] bool by_penalty() const {
    return pair.enforcement == contact::Enforcement::penalty;
  }
  void check(const pairing::PairMultipliers<Dim>& m) const {
    if (by_penalty()) throw core::InputError({}, "multipliers: the enforcement is by penalty");
    if (m.points.size() != pair.slave.points.size())
      throw core::InputError({}, fmt::format("multipliers: {} points given, {} expected",
                                             m.points.size(), pair.slave.points.size()));
    for (std::size_t i = 0; i < m.points.size(); ++i)
      if (!std::isfinite(m.points[i].normal) || !m.points[i].shear.allFinite())
        throw core::InputError({}, fmt::format("multipliers: those of point {} are not finite", i));
    if (!(m.stiffening > 0) || !std::isfinite(m.stiffening))
      throw core::InputError(
          {}, fmt::format("multipliers: stiffening must be > 0, got {:g}", m.stiffening));
  }
  [[nodiscard]] Index per_point() const { return pair.friction ? Dim + 1 : 1; }

  [[nodiscard]] BasicContactResult<Dim> evaluate(std::span<const double> coordinates,
                                                 bool with_tangent,
                                                 const pairing::PairMultipliers<Dim>* around) {
    if (coordinates.size() != Dim * nodes)
      throw core::InputError(
          {}, fmt::format("{} coordinates given, {} expected", coordinates.size(), Dim * nodes));
    pairing::evaluate<Dim>(pair, points_of<Dim>(coordinates), committed, with_tangent, evaluation,
                           {}, around);
    BasicContactResult<Dim> out;
    out.force.assign(coordinates.size(), 0.0);
    for (const pairing::ContactBlock<Dim>& block : evaluation.blocks)
      if (block.active()) add_block(block, with_tangent, out);
    out.points = evaluation.points;
    if (pair.enforcement != contact::Enforcement::lagrange_multiplier) return out;
    out.constraints.value.assign(static_cast<std::size_t>(per_point()) * evaluation.points.size(),
                                 0.0);
    for (std::size_t i = 0; i < evaluation.points.size(); ++i)
      add_constraint(evaluation.blocks[i], per_point() * static_cast<Index>(i), per_point(),
                     with_tangent, out.constraints);
    return out;
  }
};

template <int Dim>
BasicContactEvaluator<Dim>::BasicContactEvaluator(const ContactOptions& options,
                                                  BasicFacetList<Dim> master,
                                                  BasicFacetList<Dim> slave,
                                                  std::span<const double> reference)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  const std::vector<Vec<Dim>> x = points_of<Dim>(reference);
  impl_->nodes = x.size();
  pairing::PairDefinition<Dim>& pair = impl_->pair;
  pair.master = boundary_of(master, x.size(), "master");
  pair.slave = pairing::make_slave_side(boundary_of(slave, x.size(), "slave"));
  pair.normal = options.normal.value_or(contact::penalty(options.normal_penalty));
  pair.enforcement = options.enforcement;
  pair.damping = options.damping;
  pair.separation = options.separation;
  pair.tolerance = options.tolerance;
  pair.offset = options.offset;
  pair.friction = options.friction;
  pair.weight = options.weight;
  pair.residual = options.residual;
  pair.tangent = options.tangent;
  pair.area = options.area;
  check_disjoint<Dim>(master, slave);
  try {
    pairing::sample(pair.slave, options.sampling);
    pairing::prepare<Dim>(pair, x);
  } catch (const core::GeometryError& error) {
    throw core::InputError({}, std::string("slave: ") + error.what());
  }
  impl_->committed = pairing::initial_state<Dim>(pair, x);
}

template <int Dim>
BasicContactEvaluator<Dim>::~BasicContactEvaluator() = default;
template <int Dim>
BasicContactEvaluator<Dim>::BasicContactEvaluator(BasicContactEvaluator&&) noexcept = default;
template <int Dim>
BasicContactEvaluator<Dim>& BasicContactEvaluator<Dim>::operator=(
    BasicContactEvaluator&&) noexcept = default;

template <int Dim>
std::span<const Index> BasicContactEvaluator<Dim>::slave_nodes() const {
  return impl_->pair.slave.nodes;
}

template <int Dim>
std::span<const pairing::SlavePoint<Dim>> BasicContactEvaluator<Dim>::slave_points() const {
  return impl_->pair.slave.points;
}

template <int Dim>
BasicContactResult<Dim> BasicContactEvaluator<Dim>::evaluate(std::span<const double> coordinates,
                                                             bool with_tangent) {
  if (!impl_->by_penalty())
    throw core::InputError({}, "this enforcement is around multipliers: none are given");
  return impl_->evaluate(coordinates, with_tangent, nullptr);
}

template <int Dim>
BasicContactResult<Dim> BasicContactEvaluator<Dim>::evaluate(
    std::span<const double> coordinates, bool with_tangent,
    const pairing::PairMultipliers<Dim>& multipliers) {
  impl_->check(multipliers);
  return impl_->evaluate(coordinates, with_tangent, &multipliers);
}

template <int Dim>
void BasicContactEvaluator<Dim>::commit() {
  if (!impl_->evaluation.points.empty()) impl_->committed = pairing::commit(impl_->evaluation);
}

template <int Dim>
pairing::PairMultipliers<Dim> BasicContactEvaluator<Dim>::commit(
    pairing::PairMultipliers<Dim> multipliers) {
  impl_->check(multipliers);
  if (impl_->evaluation.points.empty()) return multipliers;
  commit();
  return pairing::commit(impl_->evaluation, std::move(multipliers));
}

template <int Dim>
pairing::PairMultipliers<Dim> BasicContactEvaluator<Dim>::multipliers() const {
  return pairing::initial_multipliers(impl_->pair, impl_->committed);
}

template <int Dim>
pairing::PairMultipliers<Dim> BasicContactEvaluator<Dim>::corrected(
    const pairing::PairMultipliers<Dim>& used) const {
  impl_->check(used);
  if (impl_->pair.enforcement != contact::Enforcement::augmented_lagrange)
    throw core::InputError({},
                           "multipliers that are unknowns are corrected by the host's solution");
  if (impl_->evaluation.points.empty()) return used;
  return pairing::augmented(impl_->pair, impl_->evaluation, used);
}

template <int Dim>
Index BasicContactEvaluator<Dim>::unknowns_per_point() const {
  return impl_->per_point();
}

template <int Dim>
pairing::PairMultipliers<Dim> BasicContactEvaluator<Dim>::multipliers_of(
    std::span<const double> unknowns) const {
  pairing::PairMultipliers<Dim> out = multipliers();
  const auto per = static_cast<std::size_t>(impl_->per_point());
  if (unknowns.size() != per * out.points.size())
    throw core::InputError({}, fmt::format("{} unknowns of multipliers given, {} expected",
                                           unknowns.size(), per * out.points.size()));
  const pairing::PairDefinition<Dim>& pair = impl_->pair;
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    const double* const at = unknowns.data() + per * i;
    const pairing::PointPenalty penalty = pairing::point_penalty(pair, i);
    out.points[i].normal = penalty.normal * at[0];
    if (pair.friction) out.points[i].shear = penalty.shear * Eigen::Map<const Vec<Dim>>(at + 1);
  }
  return out;
}

template class BasicContactEvaluator<2>;
template class BasicContactEvaluator<3>;

}  // namespace osculate::api
