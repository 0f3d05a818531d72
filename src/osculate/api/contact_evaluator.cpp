#include "osculate/api/contact_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/core/error.hpp"

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
      options.normal.value_or(contact::NormalPenalty{options.normal_penalty});
  std::string wrong = contact::fault(normal);
  if (wrong.empty() && options.friction) wrong = contact::fault(*options.friction);
  if (wrong.empty() && options.friction && contact::needs_duration(*options.friction))
    wrong = "friction by speed needs a time, which an evaluation does not have";
  if (wrong.empty() && options.separation != pairing::Separation::allowed &&
      !contact::holds(normal))
    wrong = "this normal law lets go: separation goes with a penalty only";
  if (wrong.empty() && !(options.offset >= 0 && std::isfinite(options.offset)))
    wrong = fmt::format("offset must be >= 0, got {:g}", options.offset);
  if (wrong.empty() && !(options.tolerance >= 0))
    wrong = fmt::format("tolerance must be >= 0, got {:g}", options.tolerance);
  if (!wrong.empty()) throw core::InputError({}, wrong);
}

void check_options(const ContactOptions& options) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  check_laws(options);
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

}  // namespace

template <int Dim>
struct BasicContactEvaluator<Dim>::Impl {
  pairing::PairDefinition<Dim> pair;
  pairing::PairState<Dim> committed;
  pairing::PairEvaluation<Dim> evaluation;
  std::size_t nodes = 0;
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
  pair.normal = options.normal.value_or(contact::NormalPenalty{options.normal_penalty});
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
  if (coordinates.size() != Dim * impl_->nodes)
    throw core::InputError({}, fmt::format("{} coordinates given, {} expected", coordinates.size(),
                                           Dim * impl_->nodes));
  pairing::evaluate<Dim>(impl_->pair, points_of<Dim>(coordinates), impl_->committed, with_tangent,
                         impl_->evaluation);
  BasicContactResult<Dim> out;
  out.force.assign(coordinates.size(), 0.0);
  for (const pairing::ContactBlock<Dim>& block : impl_->evaluation.blocks)
    if (block.active()) add_block(block, with_tangent, out);
  out.points = impl_->evaluation.points;
  return out;
}

template <int Dim>
void BasicContactEvaluator<Dim>::commit() {
  if (!impl_->evaluation.points.empty()) impl_->committed = pairing::commit(impl_->evaluation);
}

template class BasicContactEvaluator<2>;
template class BasicContactEvaluator<3>;

}  // namespace osculate::api
