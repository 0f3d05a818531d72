#include "osculate/api/contact_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

pairing::Chain chain_of(const FacetList& list, std::size_t nodes, const char* name) {
  if (list.nodes_per_facet < 2 || list.nodes_per_facet > cell::max_line_nodes)
    throw core::InputError({}, fmt::format("{}: nodes_per_facet must be 2 to {}, got {}", name,
                                           cell::max_line_nodes, list.nodes_per_facet));
  const auto per = static_cast<std::size_t>(list.nodes_per_facet);
  if (list.nodes.empty() || list.nodes.size() % per != 0)
    throw core::InputError(
        {}, fmt::format("{}: {} node numbers are no whole number of facets of {}", name,
                        list.nodes.size(), per));
  for (const Index node : list.nodes)
    if (node < 0 || static_cast<std::size_t>(node) >= nodes)
      throw core::InputError({}, fmt::format("{}: node {} does not exist", name, node));
  pairing::Chain chain;
  for (std::size_t f = 0; f < list.nodes.size(); f += per) {
    const std::span<const Index> facet = list.nodes.subspan(f, per);
    for (std::size_t k = 1; k < per; ++k)
      if (std::find(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(k), facet[k]) !=
          facet.begin() + static_cast<std::ptrdiff_t>(k))
        throw core::InputError(
            {}, fmt::format("{}: facet {} names node {} twice", name, f / per, facet[k]));
    chain.facets.push_back(pairing::lagrange_facet(facet));
  }
  pairing::connect(chain);
  return chain;
}

void check_options(const ContactOptions& options) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  if (!positive(options.normal_penalty))
    throw core::InputError(
        {}, fmt::format("normal_penalty must be > 0, got {:g}", options.normal_penalty));
  if (options.friction && (!(options.friction->mu >= 0) || !std::isfinite(options.friction->mu) ||
                           !positive(options.friction->stiffness)))
    throw core::InputError({}, fmt::format("friction needs mu >= 0 and a stiffness > 0, got {:g} "
                                           "and {:g}",
                                           options.friction->mu, options.friction->stiffness));
  if (!positive(options.area.thickness))
    throw core::InputError(
        {}, fmt::format("area.thickness must be > 0, got {:g}", options.area.thickness));
}

void check_disjoint(const FacetList& master, const FacetList& slave) {
  const std::set<Index> nodes(master.nodes.begin(), master.nodes.end());
  for (const Index node : slave.nodes)
    if (nodes.contains(node))
      throw core::InputError({}, fmt::format("node {} is on master and slave", node));
}

std::vector<Vec2> points_of(std::span<const double> values) {
  if (values.size() % 2 != 0)
    throw core::InputError({},
                           fmt::format("{} coordinates are no pairs of x and y", values.size()));
  std::vector<Vec2> x(values.size() / 2);
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] = {values[2 * n], values[2 * n + 1]};
    if (!x[n].allFinite())
      throw core::InputError({}, fmt::format("the coordinates of node {} are not finite", n));
  }
  return x;
}

void add_block(const pairing::ContactBlock<2>& block, bool with_tangent, ContactResult& out) {
  const auto row_of = [&](int k) {
    return 2 * block.nodes[static_cast<std::size_t>(k / 2)] + k % 2;
  };
  for (int i = 0; i < 2 * block.count; ++i) {
    out.force[static_cast<std::size_t>(row_of(i))] += block.force[i];
    if (!with_tangent) continue;
    for (int j = 0; j < 2 * block.count; ++j)
      out.tangent.push_back({row_of(i), row_of(j), block.tangent(i, j)});
    for (const pairing::NodeMatrix<2>& g : block.path())
      for (int d = 0; d < 2; ++d)
        out.tangent.push_back(
            {row_of(i), 2 * g.node + d, block.path_rows.row(i).dot(g.value.col(d))});
    for (const pairing::NodeGradient<2>& g : block.area)
      for (int d = 0; d < 2; ++d)
        out.tangent.push_back({row_of(i), 2 * g.node + d, block.area_rows[i] * g.value[d]});
  }
}

}  // namespace

struct ContactEvaluator::Impl {
  pairing::PairDefinition<2> pair;
  pairing::PairState<2> committed;
  pairing::PairEvaluation<2> evaluation;
  std::size_t nodes = 0;
};

ContactEvaluator::ContactEvaluator(const ContactOptions& options, FacetList master, FacetList slave,
                                   std::span<const double> reference)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  const std::vector<Vec2> x = points_of(reference);
  impl_->nodes = x.size();
  pairing::PairDefinition<2>& pair = impl_->pair;
  pair.master = chain_of(master, x.size(), "master");
  pair.slave = pairing::make_slave_side(chain_of(slave, x.size(), "slave"));
  pair.normal.stiffness = options.normal_penalty;
  pair.friction = options.friction;
  pair.weight = options.weight;
  pair.residual = options.residual;
  pair.tangent = options.tangent;
  pair.area = options.area;
  check_disjoint(master, slave);
  try {
    pairing::prepare(pair, x);
  } catch (const core::GeometryError& error) {
    throw core::InputError({}, std::string("slave: ") + error.what());
  }
  impl_->committed = pairing::initial_state(pair, x);
}

ContactEvaluator::~ContactEvaluator() = default;
ContactEvaluator::ContactEvaluator(ContactEvaluator&&) noexcept = default;
ContactEvaluator& ContactEvaluator::operator=(ContactEvaluator&&) noexcept = default;

std::span<const Index> ContactEvaluator::slave_nodes() const { return impl_->pair.slave.nodes; }

ContactResult ContactEvaluator::evaluate(std::span<const double> coordinates, bool with_tangent) {
  if (coordinates.size() != 2 * impl_->nodes)
    throw core::InputError(
        {}, fmt::format("{} coordinates given, {} expected", coordinates.size(), 2 * impl_->nodes));
  pairing::evaluate(impl_->pair, points_of(coordinates), impl_->committed, with_tangent,
                    impl_->evaluation);
  ContactResult out;
  out.force.assign(coordinates.size(), 0.0);
  for (const pairing::ContactBlock<2>& block : impl_->evaluation.blocks)
    if (block.active()) add_block(block, with_tangent, out);
  out.points = impl_->evaluation.points;
  return out;
}

void ContactEvaluator::commit() {
  if (!impl_->evaluation.points.empty()) impl_->committed = pairing::commit(impl_->evaluation);
}

}  // namespace osculate::api
