// `penalty: auto`: the stiffness of a contact from that of the bodies behind it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/deck/layers_behind.hpp"

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

/// Both sides of a contact: as a whole, and facet by facet (or node by node).
struct BothSides {
  std::vector<LayerSum> slaves, masters;
  Layer slave, master;
};

template <int Dim>
BothSides sides_of(BuildContext<Dim>& c, const pairing::PairDefinition<Dim>& pair) {
  const pairing::Boundary<Dim>& facets = pair.slave.boundary;
  BothSides sides;
  sides.slaves =
      facets.facets.empty() ? layers_behind(c, pair.slave.nodes) : layers_behind(c, facets);
  sides.masters = layers_behind(c, pair.master);
  sides.slave = beside(sides.slaves);
  sides.master = beside(sides.masters);
  return sides;
}

/// Least and largest of one of the stiffnesses over parts of a side; a rigid part has no end.
std::array<double, 2> range_of(const std::vector<LayerSum>& parts, double Layer::*stiffness) {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0};
  for (const LayerSum& part : parts) {
    const double rigid = std::numeric_limits<double>::infinity();
    const double own = part.sum.area > 0 ? part.sum.*stiffness / part.sum.area : rigid;
    range = {std::min(range[0], own), std::max(range[1], own)};
  }
  return range;
}

/// Whether any two places of both sides can differ from the means by more than is let pass.
bool differ(const BothSides& sides) {
  for (double Layer::*const stiffness : {&Layer::normal, &Layer::shear}) {
    const std::array<double, 2> s = range_of(sides.slaves, stiffness),
                                m = range_of(sides.masters, stiffness);
    const double mean = in_series(sides.slave.*stiffness, sides.master.*stiffness);
    for (const std::size_t end : {0, 1})
      if (own_share(1 / (1 / s[end] + 1 / m[end]) / mean) != 1) return true;
  }
  return false;
}

/// Factors of the single points, and the heights of the cells there, if any of them differs.
template <int Dim>
void set_points(BuildContext<Dim>& c, const BothSides& sides, bool normal, bool shear,
                model::BasicContactPair<Dim>& out) {
  if (!differ(sides)) return;
  pairing::PairDefinition<Dim>& pair = out.definition;
  const std::vector<Layer> slaves = layers_at_points(c, pair.slave, sides.slaves);
  Layer anywhere = sides.master;
  anywhere.thinnest = std::numeric_limits<double>::infinity();
  const std::vector<Layer> masters =
      layers_facing(pair, c.model().reference, sides.masters, anywhere);
  const auto factor = [&](std::size_t i, double Layer::*stiffness) {
    const double own = in_series(slaves[i].*stiffness, masters[i].*stiffness);
    const double mean = in_series(sides.slave.*stiffness, sides.master.*stiffness);
    return own > 0 ? own_share(own / mean) : 1.0;
  };
  bool apart = false;
  std::vector<pairing::RelativeStiffness> factors(slaves.size());
  std::vector<double> heights;
  for (std::size_t i = 0; i < slaves.size(); ++i) {
    const double of_normal = factor(i, &Layer::normal), of_shear = factor(i, &Layer::shear);
    apart = apart || of_normal != 1 || of_shear != 1;
    if (normal) factors[i].normal = of_normal;
    if (shear) factors[i].shear = of_shear;
    const double height = std::min(slaves[i].thinnest, masters[i].thinnest);
    heights.push_back(std::isfinite(height) ? height : out.height);
  }
  if (!apart) return;
  out.heights = std::move(heights);
  if (normal || shear) pair.relative_stiffness = std::move(factors);
}

}  // namespace

template <int Dim>
void set_automatic(BuildContext<Dim>& c, const Contact& contact,
                   model::BasicContactPair<Dim>& out) {
  pairing::PairDefinition<Dim>& pair = out.definition;
  const BothSides sides = sides_of(c, pair);
  const Layer &slave = sides.slave, &master = sides.master;
  out.height = slave.size > 0 && master.size > 0 ? std::min(slave.size, master.size)
                                                 : slave.size + master.size;
  const GivenLaw<contact::NormalLaw>& law = contact.normal.law;
  out.automatic = law.automatic;
  const bool shear = contact.friction && contact.friction->automatic;
  set_points(c, sides, law.automatic, shear, out);
  if (!law.automatic && !shear) return;
  const core::SourceMark& mark = law.automatic ? law.stiffness : contact.friction->stiffness;
  const double normal = in_series(slave.normal, master.normal);
  if (!(normal > 0))
    throw core::InputError(
        mark,
        fmt::format("'auto' finds no deformable cell behind the facets of '{}': give a number",
                    out.name));
  const double per = pair.weight == pairing::Weight::node ? area_per_point(c, pair, mark) : 1.0;
  if (law.automatic)
    pair.normal = contact::with_stiffness(pair.normal, automatic_factor * normal * per);
  if (shear)
    pair.friction = contact::with_stiffness(
        *pair.friction, automatic_factor * in_series(slave.shear, master.shear) * per);
}

template void set_automatic(BuildContext<2>&, const Contact&, model::ContactPair&);
template void set_automatic(BuildContext<3>&, const Contact&, model::ContactPair3&);

}  // namespace osculate::deck
