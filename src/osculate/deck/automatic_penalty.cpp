// `penalty: auto`: the stiffness of a contact from that of the bodies behind it.
#include <fmt/format.h>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/model/automatic_penalty.hpp"

namespace osculate::deck {
namespace {

/// Area that belongs to one slave point: what a penalty per area becomes per node.
template <int Dim>
double area_per_point(const BuildContext<Dim>& c, const pairing::PairDefinition<Dim>& pair,
                      const core::SourceMark& mark) {
  pairing::PairDefinition<Dim> measured = pair;
  measured.weight = pairing::Weight::reference_area;
  double sum = 0;
  try {
    pairing::prepare(measured, c.model().reference);
    for (const double area : measured.reference_areas) sum += area;
  } catch (const core::GeometryError&) {
    sum = 0;
  }
  if (!(sum > 0))
    throw core::InputError(mark,
                           "'auto' needs an area for each slave point, and these have none: give a "
                           "number, or facets as the slave");
  return sum / static_cast<double>(measured.reference_areas.size());
}

/// A given penalty beside which the bodies are lost in rounding.
template <int Dim>
void warn_of_stiff(BuildContext<Dim>& c, const model::BasicContactPair<Dim>& pair,
                   double automatic) {
  constexpr double most = 1e7;
  const double given = contact::penalty_of(pair.definition.normal);
  if (pair.definition.weight == pairing::Weight::node || pairing::by_multipliers(pair.definition) ||
      !(automatic > 0) || !(given > most * automatic))
    return;
  c.built.warnings.push_back(fmt::format(
      "contact '{}': its penalty of {:.3g} is {:.1g} times the automatic one ({:.3g}): rounding of "
      "forces so stiff hides the rest, and iterations may not end; leave it out",
      pair.name, given, given / automatic, automatic));
}

}  // namespace

template <int Dim>
void set_automatic(BuildContext<Dim>& c, const Contact& contact,
                   model::BasicContactPair<Dim>& out) {
  if (!c.cells_of_node) c.cells_of_node.emplace(c.model());
  pairing::PairDefinition<Dim>& pair = out.definition;
  const model::BothSides sides = model::sides_of(c.model(), *c.cells_of_node, pair);
  out.height = model::height_of(sides);
  const GivenLaw<contact::NormalLaw>& law = contact.normal.law;
  out.automatic = law.automatic;
  const bool shear = contact.friction && contact.friction->automatic;
  model::set_point_factors(c.model(), *c.cells_of_node, sides, law.automatic, shear, out);
  const model::AutomaticStiffness stiffness = model::automatic_stiffness(sides);
  if (!law.automatic) warn_of_stiff(c, out, stiffness.normal);
  if (!law.automatic && !shear) return;
  const core::SourceMark& mark = law.automatic ? law.stiffness : contact.friction->stiffness;
  if (!(stiffness.normal > 0))
    throw core::InputError(
        mark,
        fmt::format("'auto' finds no deformable cell behind the facets of '{}': give a number",
                    out.name));
  const double per = pair.weight == pairing::Weight::node ? area_per_point(c, pair, mark) : 1.0;
  const double factor = contact.normal.auto_factor ? contact.normal.auto_factor->value : 1;
  if (law.automatic)
    pair.normal = contact::with_stiffness(pair.normal, factor * stiffness.normal * per);
  if (shear) pair.friction = contact::with_stiffness(*pair.friction, stiffness.shear * per);
}

template void set_automatic(BuildContext<2>&, const Contact&, model::ContactPair&);
template void set_automatic(BuildContext<3>&, const Contact&, model::ContactPair3&);

}  // namespace osculate::deck
