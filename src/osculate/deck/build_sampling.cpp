// Where on the slave contact is tested.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {
namespace {

/// The areas of the nodes of tri6 and quad8 facets are positive, but not those of a uniform
/// pressure.
bool scatters(const pairing::Facet&) { return false; }
bool scatters(const pairing::SurfaceFacet& facet) {
  return facet.type == cell::CellType::tri6 || facet.type == cell::CellType::quad8;
}

void warn_of_scatter(BuildContext<2>&, const Contact&, const pairing::PairDefinition<2>&) {}
void warn_of_scatter(BuildContext<3>& c, const Contact& contact,
                     const pairing::PairDefinition<3>& pair) {
  if (!pairing::sampled_at_nodes(pair.slave) || pairing::by_mortar(pair)) return;
  for (const pairing::SurfaceFacet& facet : pair.slave.boundary.facets) {
    if (!scatters(facet)) continue;
    if (c.model().body_of_node[static_cast<std::size_t>(facet.nodes[0])] >= 0) continue;
    c.built.warnings.push_back(fmt::format(
        "contact '{}': the slave '{}' has {} faces, at whose nodes contact pressures scatter; "
        "prefer sampling: {{gauss: 3}}, hex27 or first-order cells there, or make it the master",
        contact.name.value, contact.slave.value, cell::info(facet.type).name));
    return;
  }
}

int corner_count(const pairing::Facet&) { return 2; }
int corner_count(const pairing::SurfaceFacet& facet) { return pairing::edge_count(facet); }

/// Whether nodes are what `sampling: auto` means, whatever the sides are.
template <int Dim>
bool needs_nodes(const BuildContext<Dim>& c, const Contact& contact) {
  const auto is_explicit = [](const Step& step) {
    return step.dynamics && step.dynamics->scheme == SchemeWord::central_differences;
  };
  return !contact.normal.law.automatic || contact.edges || contact.two_pass ||
         contact.weight.value == ContactWeight::node || contact.area > 0 || contact.area_by ||
         contact.enforcement.value.kind != EnforcementWord::penalty ||
         std::ranges::any_of(c.description.steps, is_explicit);
}

/// What `sampling: auto` means for these sides. Nodes of a coarse slave miss what lies between them
/// on a finer master, and jump between its facets at corners; where the master is a plain shape
/// neither can be. There are more Gauss points than nodes: beyond the stiffness that the program
/// chooses their tractions would begin to scatter.
///
/// Decision   docs/decisions/035-sampling-by-default.md
template <int Dim>
Sampling chosen_sampling(const BuildContext<Dim>& c, const Contact& contact,
                         const pairing::PairDefinition<Dim>& pair) {
  const Sampling& asked = contact.sampling.value;
  if (asked.rule != SamplingRule::automatic) return asked;
  const auto& facets = pair.slave.boundary.facets;
  const auto curved = [](const auto& f) { return f.count > corner_count(f); };
  const auto has_mesh = [](const auto& f) { return !f.shape; };
  const auto scatter = [](const auto& f) { return scatters(f); };
  const auto without_facet = [](const std::vector<Index>& of) { return of.empty(); };
  const bool useful =
      std::ranges::any_of(pair.master.facets, has_mesh) || std::ranges::any_of(facets, scatter);
  if (!useful || needs_nodes(c, contact) || pair.filter.limited() ||
      std::ranges::any_of(pair.slave.facets_of, without_facet))
    return {SamplingRule::nodes};
  return {SamplingRule::gauss, std::ranges::any_of(facets, curved) ? 3 : 2};
}

pairing::Sampling rule_of(const Sampling& s) {
  using Rule = pairing::Sampling::Rule;
  const Rule rule = s.rule == SamplingRule::gauss     ? Rule::gauss
                    : s.rule == SamplingRule::lobatto ? Rule::lobatto
                                                      : Rule::nodes;
  return {rule, s.points, s.subdomains, s.segments};
}

/// Nodes of the coarser of two deformable sides: what lies between them on the other is not seen.
template <int Dim>
void warn_of_coarse_nodes(BuildContext<Dim>& c, const Contact& contact,
                          const pairing::PairDefinition<Dim>& pair) {
  constexpr double coarser = 1.5;
  if (contact.two_pass || pairing::by_mortar(pair) || !pairing::sampled_at_nodes(pair.slave))
    return;
  const auto rigid = [&](const auto& f) {
    return c.model().body_of_node[static_cast<std::size_t>(f.nodes[0])] >= 0;
  };
  if (std::ranges::any_of(pair.slave.boundary.facets, rigid) ||
      std::ranges::any_of(pair.master.facets, rigid))
    return;
  const double slave = mean_size<Dim>(pair.slave.boundary, c.model().reference);
  const double master = mean_size<Dim>(pair.master, c.model().reference);
  if (!(slave > coarser * master)) return;
  c.built.warnings.push_back(fmt::format(
      "contact '{}': the facets of the slave '{}' are {:.2g} times as long as those of '{}', and "
      "its nodes alone are tested for contact: pressures are off by some per cent; name the finer "
      "side slave, or use sampling: {}",
      contact.name.value, contact.slave.value, slave / master, contact.master.value,
      contact.enforcement.value.kind == EnforcementWord::lagrange_multiplier
          ? "mortar"
          : "{gauss: 2} or mortar"));
}

}  // namespace

template <int Dim>
void set_points(BuildContext<Dim>& c, const Contact& contact, pairing::PairDefinition<Dim>& pair) {
  try {
    pairing::sample<Dim>(pair.slave, rule_of(chosen_sampling(c, contact, pair)),
                         {&pair.master, c.model().reference});
  } catch (const core::GeometryError& error) {
    throw core::InputError(contact.sampling.mark, error.what());
  }
  warn_of_scatter(c, contact, pair);
  warn_of_coarse_nodes(c, contact, pair);
}

template void set_points<2>(BuildContext<2>&, const Contact&, pairing::PairDefinition<2>&);
template void set_points<3>(BuildContext<3>&, const Contact&, pairing::PairDefinition<3>&);

}  // namespace osculate::deck
