#include "osculate/automatic_penalty.hpp"

#include <fmt/format.h>

#include <cmath>

#include "osculate/errors.hpp"
#include "osculate/pairing/automatic_stiffness.hpp"

namespace osculate {
namespace {

void check(const Layer& layer) {
  const bool rigid = layer.young == 0;
  const bool numbers = std::isfinite(layer.young) && layer.young >= 0 && layer.poisson > -1 &&
                       layer.poisson <= 0.5 && std::isfinite(layer.area) && layer.area >= 0;
  if (!numbers || (!rigid && !(layer.height > 0 && std::isfinite(layer.height))))
    throw Refused(
        fmt::format("a layer needs young >= 0, poisson above -1 and at most 1/2, a height > 0 and "
                    "an area >= 0, got {:g}, {:g}, {:g} and {:g}",
                    layer.young, layer.poisson, layer.height, layer.area));
}

/// E / h and G / h of a side, averaged over the areas of the layers that give way.
Penalties stiffness_of(std::span<const Layer> side) {
  Penalties sum;
  double area = 0;
  for (const Layer& layer : side) {
    check(layer);
    if (layer.young == 0) continue;
    sum.normal += layer.area * layer.young / layer.height;
    sum.shear += layer.area * layer.young / (2 * (1 + layer.poisson)) / layer.height;
    area += layer.area;
  }
  return area > 0 ? Penalties{sum.normal / area, sum.shear / area} : Penalties{};
}

}  // namespace

Penalties automatic_penalties(std::span<const Layer> slave, std::span<const Layer> master) {
  const Penalties s = stiffness_of(slave), m = stiffness_of(master);
  const double normal = pairing::in_series(s.normal, m.normal);
  if (!(normal > 0)) throw Refused("both sides are rigid: nothing says how stiff the contact is");
  return {pairing::automatic_factor * normal,
          pairing::automatic_factor * pairing::in_series(s.shear, m.shear)};
}

double penalty_factor(double ratio) { return pairing::own_factor(ratio); }

}  // namespace osculate
