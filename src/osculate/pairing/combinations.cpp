#include "osculate/pairing/combinations.hpp"

#include <algorithm>
#include <array>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/pairing/mortar_cell.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::pairing {
namespace {

using enum Trait;

// In the order in which a pair is asked.
constexpr std::array table{
    Refusal{quadrature, own_surface, "contact of a surface with itself is sampled at nodes only"},
    Refusal{mortar, own_surface, "contact of a surface with itself is sampled at nodes only"},
    Refusal{quadrature, edges, "contact of edges goes with sampling: nodes only"},
    Refusal{mortar, edges, "contact of edges goes with sampling: nodes only"},
    Refusal{two_pass, mortar, "mortar treats both sides in one pass: leave out two_pass"},
    Refusal{nodal_weight, mortar,
            "mortar integrates over areas: use reference_area or current_area"},
    Refusal{full_residual, mortar, "mortar has its own form of the forces: use surface"},
    Refusal{covariant_tangent, mortar, "mortar has the consistent tangent only"},
    Refusal{printed_history, mortar, "mortar has its own history, without borders: use continuous"},
    Refusal{smoothed_master, mortar, "mortar integrates over the facets of the mesh: use none"},
    Refusal{relieved_overlap, mortar, "mortar knows initial overlaps only as they are: use adjust"},
    Refusal{given_clearance, mortar, "mortar knows initial gaps only as they are in the mesh"},
    Refusal{given_clearance, own_surface,
            "a clearance is that of two surfaces: name master and slave"},
    Refusal{given_clearance, keeps_gap,
            "points that are held from the start keep the gap they have"},
    Refusal{relieved_overlap, keeps_gap,
            "points that keep the gap they have do not press: leave out initial"},
    Refusal{given_clearance, edges, "edge-edge contacts have no gap at the start"},
    Refusal{corrected, gap_law,
            "a law that gives the pressure as a function of the gap is met by itself: use penalty"},
    Refusal{corrected, damping,
            "damping is a part of the spring that a penalty is, and corrected or unknown tractions "
            "have none: use penalty, or leave out damping"},
    Refusal{corrected, tied, "tied points are held by penalty only"},
    Refusal{slides, tied,
            "tied points do not slide: leave out friction, or use rough, whose penalty is their "
            "stiffness along the master"},
    Refusal{corrected, named_edges,
            "edge-edge contacts come and go: they are enforced by penalty only"},
    Refusal{multipliers, own_surface,
            "with both sides as slaves there are more unknown tractions than nodes that could "
            "carry them: use penalty or augmented_lagrange"},
    Refusal{multipliers, two_pass,
            "with both sides as slaves there are more unknown tractions than nodes that could "
            "carry them: use penalty or augmented_lagrange"},
    Refusal{multipliers, quadrature,
            "facets have more quadrature points than nodes, so their tractions cannot all be "
            "unknown: use sampling: nodes or mortar, or augmented_lagrange"},
    Refusal{full_residual, multipliers,
            "unknown tractions have the form surface only: without penetration there is no other"},
    Refusal{covariant_tangent, multipliers, "unknown tractions have the consistent tangent only"},
    Refusal{two_pass, own_surface, "contact of a surface with itself has two passes already"},
    Refusal{two_pass, edges, "edge-edge contacts have no second pass"},
    Refusal{edges, points_only, "only facets have edges"},
    Refusal{named_edges, own_surface, "the edges of a surface do not touch each other"},
    Refusal{damping, held,
            "points that are held do not part, and an impact of theirs has no end: damping goes "
            "with separation: allowed only"},
    Refusal{held, gap_law,
            "holding points needs a stiffness in tension: it goes with penalty only"},
    Refusal{held_from_start, own_surface,
            "a surface cannot be tied to itself: name master and slave"},
    Refusal{held_from_start, edges,
            "edge-edge contacts are found while the bodies move: they cannot be tied from the "
            "start"},
    Refusal{mortar, analytic_master,
            "mortar takes sides with nodes, and other samplings any master"},
    Refusal{mortar, points_only, "mortar integrates over facets, and the slave is a set of points"},
    Refusal{mortar, long_lines, "mortar takes lines of up to 4 nodes"},
    Refusal{two_pass, analytic_master, "it has no points to be a slave"},
    Refusal{two_pass, points_only, "it cannot be master"},
    Refusal{explicit_time, corrected,
            "multipliers, which central differences cannot find: they need the force of a penalty"},
};

bool is_long(const Facet& facet) { return facet.count > max_mortar_line; }
bool is_long(const SurfaceFacet&) { return false; }
bool is_smoothed(const Facet& facet) { return facet.bezier != nullptr; }
bool is_smoothed(const SurfaceFacet& facet) { return facet.patch != nullptr; }

}  // namespace

std::span<const Refusal> refusals() { return table; }

const Refusal* refusal(const Traits& traits) {
  const auto* const found = std::ranges::find_if(
      table, [&](const Refusal& r) { return traits.has(r.told_at) && traits.has(r.other); });
  return found == table.end() ? nullptr : &*found;
}

std::string_view why_not(Trait told_at, Trait other) {
  Traits both;
  both.add(told_at);
  both.add(other);
  const Refusal* const found = refusal(both);
  return found ? found->why : std::string_view();
}

template <int Dim>
Traits traits_of(const PairDefinition<Dim>& pair) {
  Traits t;
  const auto& facets = pair.master.facets;
  t.add(own_surface, pair.filter.limited());
  t.add(two_pass, pair.pass_factor != 1 && !pair.filter.limited());
  t.add(quadrature, !sampled_at_nodes(pair.slave));
  t.add(mortar, by_mortar(pair));
  t.add(edges, edges_of(pair) != nullptr);
  const auto any = [](const auto& list, const auto& is) { return std::ranges::any_of(list, is); };
  const auto too_long = [](const auto& f) { return is_long(f); };
  t.add(points_only, any(pair.slave.facets_of, [](const auto& of) { return of.empty(); }));
  t.add(analytic_master, any(facets, [](const auto& f) { return static_cast<bool>(f.shape); }));
  t.add(smoothed_master, any(facets, [](const auto& f) { return is_smoothed(f); }));
  t.add(long_lines, any(facets, too_long) || any(pair.slave.boundary.facets, too_long));
  t.add(gap_law, !contact::augmentable(pair.normal));
  t.add(damping, pair.damping.has_value());
  t.add(held, !is<MayPart>(pair.separation));
  t.add(Trait::held_from_start, pairing::held_from_start(pair));
  const auto* const ties = std::get_if<Tied<Dim>>(&pair.separation);
  t.add(keeps_gap, is<TiedNormal>(pair.separation) || (ties && ties->keep_gap));
  t.add(tied, ties);
  t.add(slides, pair.friction && !pair.friction->template as<contact::Rough>());
  t.add(relieved_overlap,
        pair.overlap == InitialOverlap::ramped || pair.overlap == InitialOverlap::kept);
  t.add(given_clearance, pair.overlap == InitialOverlap::given);
  t.add(corrected, !is<ByPenalty>(pair.enforcement));
  t.add(multipliers, by_multipliers(pair));
  t.add(nodal_weight, pair.weight == Weight::node);
  t.add(full_residual, pair.residual == contact::ResidualForm::full);
  t.add(covariant_tangent, !pair.tangent.consistent);
  t.add(printed_history, pair.history != HistoryRule::continuous);
  return t;
}

std::string_view name_of(Trait trait) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(count)> names{
      "contact of a surface with itself, or of all bodies",
      "`two_pass`",
      "`sampling: gauss` or `lobatto`",
      "`sampling: mortar`",
      "`edges`",
      "`edges` of a named pair",
      "slave: a set of points",
      "master: an analytic shape",
      "`smoothing`",
      "lines of more than 4 nodes",
      "`normal: exponential`, `decaying`, `tensile` or `table`",
      "`damping`",
      "`separation: no_separation`, `tied_normal` or `tied`",
      "`separation: tied_normal` or `tied`",
      "`separation: tied_normal`, or `tied` with `initial_gap: keep`",
      "`separation: tied`",
      "`friction` other than `rough`",
      "`initial: ramp` or `keep`",
      "`initial: clearance`",
      "`enforcement: augmented_lagrange` or `lagrange_multiplier`",
      "`enforcement: lagrange_multiplier`",
      "`weight: node`",
      "`residual: full`",
      "`tangent: covariant`, or parts of it",
      "`history: chord` or `per_facet`",
      "central differences"};
  return names[static_cast<std::size_t>(trait)];
}

template Traits traits_of<2>(const PairDefinition<2>&);
template Traits traits_of<3>(const PairDefinition<3>&);

}  // namespace osculate::pairing
