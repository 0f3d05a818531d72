#include "osculate/embed/definition.hpp"

#include <fmt/format.h>

#include <set>

#include "osculate/embed/laws.hpp"
#include "osculate/embed/rules.hpp"
#include "osculate/embed/surfaces.hpp"
#include "osculate/pairing/facet_size.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::embed {
namespace {

/// The kernel's value of a choice that is listed in the same order.
template <class Ours, class Theirs>
constexpr Ours same(Theirs choice) {
  return static_cast<Ours>(choice);
}
static_assert(same<pairing::Weight>(Weight::current_area) == pairing::Weight::current_area);
static_assert(same<pairing::InitialOverlap>(InitialOverlap::kept) == pairing::InitialOverlap::kept);
static_assert(same<pairing::HistoryRule>(HistoryRule::per_facet) ==
              pairing::HistoryRule::per_facet);
static_assert(same<contact::ResidualForm>(ResidualForm::full) == contact::ResidualForm::full);
static_assert(same<pairing::SmoothingKind>(Smoothing::Kind::nurbs) ==
              pairing::SmoothingKind::nurbs);
static_assert(same<pairing::Sampling::Rule>(Sampling::Rule::lobatto) ==
              pairing::Sampling::Rule::lobatto);

template <int Dim>
void check_disjoint(const pairing::PairDefinition<Dim>& pair) {
  std::set<Index> nodes;
  for (const auto& f : pair.master.facets) nodes.insert(f.nodes.begin(), f.nodes.begin() + f.count);
  for (const Index node : pair.slave.nodes)
    if (nodes.contains(node)) throw Refused(fmt::format("node {} is on master and slave", node));
}

bool first_order(const pairing::Facet& f) { return f.count == 2; }
bool first_order(const pairing::SurfaceFacet& f) {
  return f.type == cell::CellType::quad4 || f.type == cell::CellType::tri3;
}

template <int Dim>
void smooth_master(const Smoothing& asked, std::span<const Vec<Dim>> x,
                   pairing::PairDefinition<Dim>& pair) {
  if (asked.kind == Smoothing::Kind::none) return;
  for (const auto& facet : pair.master.facets)
    if (!first_order(facet)) throw Refused("smoothing is for facets of first order");
  pairing::smooth(pair.master, x, {same<pairing::SmoothingKind>(asked.kind), asked.sharp_angle});
}

template <int Dim>
void set_sides(const Contact<Dim>& c, const std::vector<Vec<Dim>>& x,
               pairing::PairDefinition<Dim>& pair) {
  pair.master = boundary_of(c.master, x.size(), "master");
  if (c.slave) {
    pairing::Boundary<Dim> boundary = boundary_of(*c.slave, x.size(), "slave");
    pair.slave = pairing::make_slave_side(std::move(boundary), c.slave->points);
    check_disjoint(pair);
  } else {
    pair.slave = pairing::make_slave_side(pair.master);
    pair.filter.own = true;
    pair.filter.distance =
        pairing::search_distance_in_facets * pairing::mean_facet_size(pair.master, x);
  }
  if (c.search_distance) pair.filter.distance = *c.search_distance;
}

template <int Dim>
pairing::Separation<Dim> separation_of(const Contact<Dim>& c) {
  switch (c.separation) {
    case Separation::allowed:
      break;
    case Separation::no_separation:
      return pairing::NeverPart{};
    case Separation::tied_normal:
      return pairing::TiedNormal{c.tolerance};
    case Separation::tied:
      return pairing::Tied<Dim>{c.tolerance, c.keep_gap};
  }
  return pairing::MayPart{};
}

/// The target of augmented Lagrangians is the host's, who corrects them.
template <int Dim>
pairing::Enforcement enforcement_of(const Contact<Dim>& c) {
  switch (c.enforcement) {
    case Enforcement::penalty:
      break;
    case Enforcement::augmented_lagrange:
      return pairing::ByAugmentedLagrange{};
    case Enforcement::lagrange_multiplier: {
      // In the plane all corners; in space meshes have them in every fold that is meant to be
      // round.
      const double least = Dim == 2 ? 0 : pairing::ByMultipliers::default_reentrant_angle;
      return pairing::ByMultipliers{c.reentrant_vertices ? least
                                                         : std::numeric_limits<double>::infinity()};
    }
  }
  return pairing::ByPenalty{};
}

template <int Dim>
void set_laws(const Contact<Dim>& c, pairing::PairDefinition<Dim>& pair) {
  pair.normal = law_of(c.normal);
  if (c.friction) pair.friction = law_of(*c.friction, c.separation == Separation::allowed);
  if (c.damping) pair.damping = law_of(*c.damping);
  for (const PenaltyFactors& f : c.factors) pair.relative_stiffness.push_back({f.normal, f.shear});
  pair.separation = separation_of(c);
  pair.offset = c.offset;
}

template <int Dim>
void set_forms(const Contact<Dim>& c, pairing::PairDefinition<Dim>& pair) {
  pair.enforcement = enforcement_of(c);
  pair.weight = same<pairing::Weight>(c.weight);
  pair.residual = same<contact::ResidualForm>(c.residual);
  pair.tangent = {c.tangent.consistent, c.tangent.main, c.tangent.rotational, c.tangent.curvature};
  pair.history = same<pairing::HistoryRule>(c.history);
  pair.area = {c.area.thickness, c.area.axisymmetric};
  pair.pass_factor = c.part;
  pair.depth = c.depth;
  pair.overlap = same<pairing::InitialOverlap>(c.overlap);
  if (c.sampling.rule == Sampling::Rule::mortar) pair.sampler = pairing::ByMortar<Dim>{};
  if (c.edge_angle) pair.sampler = pairing::AtEdgesToo{.angle = *c.edge_angle};
}

}  // namespace

template <int Dim>
Definition<Dim> define(const Contact<Dim>& c, std::span<const double> reference) {
  if (const std::string wrong = refusal(c); !wrong.empty()) throw Refused(wrong);
  const std::vector<Vec<Dim>> x = points_of<Dim>(reference);
  Definition<Dim> out;
  out.nodes = x.size();
  out.key = key_of(c, reference);
  pairing::PairDefinition<Dim>& pair = out.pair;
  set_sides(c, x, pair);
  set_laws(c, pair);
  set_forms(c, pair);
  refusing("master: ", [&] { smooth_master<Dim>(c.smoothing, x, pair); });
  const bool points = !pairing::by_mortar(pair) && c.sampling.rule != Sampling::Rule::nodes;
  refusing("slave: ", [&] {
    if (points)
      pairing::sample(pair.slave, {same<pairing::Sampling::Rule>(c.sampling.rule),
                                   c.sampling.points, c.sampling.subdomains});
    pairing::prepare<Dim>(pair, x);
  });
  if (!pair.relative_stiffness.empty() &&
      pair.relative_stiffness.size() != pair.slave.points.size())
    throw Refused(fmt::format("factors: {} given, and the slave has {} points",
                              pair.relative_stiffness.size(), pair.slave.points.size()));
  return out;
}

template Definition<2> define(const Contact<2>&, std::span<const double>);
template Definition<3> define(const Contact<3>&, std::span<const double>);

}  // namespace osculate::embed
