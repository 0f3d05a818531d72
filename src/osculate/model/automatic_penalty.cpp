#include "osculate/model/automatic_penalty.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/pairing/automatic_stiffness.hpp"

namespace osculate::model {
namespace {

using pairing::in_series;
using pairing::own_factor;

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
      if (own_factor(1 / (1 / s[end] + 1 / m[end]) / mean) != 1) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
BothSides sides_of(const BasicModel<Dim>& model, const CellsOfNodes<Dim>& cells,
                   const pairing::PairDefinition<Dim>& pair) {
  const pairing::Boundary<Dim>& facets = pair.slave.boundary;
  BothSides sides;
  sides.slaves = facets.facets.empty() ? layers_behind(model, cells, pair.slave.nodes)
                                       : layers_behind(model, cells, facets);
  sides.masters = layers_behind(model, cells, pair.master);
  sides.slave = beside(sides.slaves);
  sides.master = beside(sides.masters);
  return sides;
}

double height_of(const BothSides& sides) {
  const double slave = sides.slave.size, master = sides.master.size;
  return slave > 0 && master > 0 ? std::min(slave, master) : slave + master;
}

AutomaticStiffness automatic_stiffness(const BothSides& sides) {
  return {pairing::automatic_factor * in_series(sides.slave.normal, sides.master.normal),
          pairing::automatic_factor * in_series(sides.slave.shear, sides.master.shear)};
}

template <int Dim>
void set_point_factors(const BasicModel<Dim>& model, const CellsOfNodes<Dim>& cells,
                       const BothSides& sides, bool normal, bool shear,
                       BasicContactPair<Dim>& out) {
  if (!differ(sides)) return;
  pairing::PairDefinition<Dim>& pair = out.definition;
  const std::vector<Layer> slaves = layers_at_points(model, cells, pair.slave, sides.slaves);
  Layer anywhere = sides.master;
  anywhere.thinnest = std::numeric_limits<double>::infinity();
  const std::vector<Layer> masters = layers_facing(pair, model.reference, sides.masters, anywhere);
  const auto factor = [&](std::size_t i, double Layer::*stiffness) {
    const double own = in_series(slaves[i].*stiffness, masters[i].*stiffness);
    const double mean = in_series(sides.slave.*stiffness, sides.master.*stiffness);
    return own > 0 ? own_factor(own / mean) : 1.0;
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

template BothSides sides_of(const Model&, const CellsOfNodes<2>&,
                            const pairing::PairDefinition<2>&);
template BothSides sides_of(const Model3&, const CellsOfNodes<3>&,
                            const pairing::PairDefinition<3>&);
template void set_point_factors(const Model&, const CellsOfNodes<2>&, const BothSides&, bool, bool,
                                ContactPair&);
template void set_point_factors(const Model3&, const CellsOfNodes<3>&, const BothSides&, bool, bool,
                                ContactPair3&);

}  // namespace osculate::model
