#pragma once
// What re-entrant vertices of the plane and re-entrant edges in space decide by the same words; for
// sources of this layer.
#include <algorithm>

#include "osculate/pairing/response.hpp"

namespace osculate::pairing {

/// The state that the tractions of a point belong to: the corner at a place of the master, a facet,
/// or neither where it was open.
template <int Dim>
struct StateBefore {
  bool reentrant = false;
  Index facet = -1;
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();
};

/// `rests()`: whether the point was held in a corner at the end of the last increment.
template <int Dim, class Rests>
[[nodiscard]] StateBefore<Dim> state_before(const contact::PointHistory<Dim>& history,
                                            const PointContext<Dim>& context, const Rests& rests) {
  const ActiveBranch<Dim>& last = context.active;
  if (last.branch == contact::Branch::reentrant) return {true, last.facet, last.xi};
  if (last.branch != contact::Branch::none && last.facet >= 0) return {false, last.facet, last.xi};
  const bool of_history = context.predict || !context.known;
  if (!of_history || !history.active) return {};
  return {rests(), history.facet, history.xi};
}

/// Whether a facet's law lets the traction slide.
template <int Dim>
[[nodiscard]] bool slides_on_facet(const PairDefinition<Dim>& pair,
                                   const contact::PointHistory<Dim>& history, double normal,
                                   const Vec<Dim - 1>& shear, const PointContext<Dim>& context) {
  return !pair.friction || contact::response<Dim>(friction_law(pair, normal, context), shear,
                                                  normal, sliding_of(history, context))
                                   .status == contact::Status::slip;
}

/// The facet (0 or 1) on which a traction leaves the corner; -1: it is held. `away[k]` leads from
/// the corner into facet k, `slides(k)` asks its law. On the facet along which the point has
/// `arrived` in this increment, it is held only if that does not hold it before.
template <int Dim, class Slides>
[[nodiscard]] int left_side(const Vec<Dim>& traction, const std::array<Vec<Dim>, 2>& normal,
                            const std::array<Vec<Dim>, 2>& away, int arrived,
                            const Slides& slides) {
  int side = -1;
  double least = 0;
  for (int k = 0; k < 2; ++k) {
    const auto s = static_cast<std::size_t>(k);
    const double push = traction.dot(normal[s]);
    const bool leads_away = traction.dot(away[s]) > 0, sliding = slides(k);
    const bool leaves = k == arrived ? leads_away || !sliding : leads_away && sliding;
    if (!leaves || (side >= 0 && push >= least)) continue;
    side = k;
    least = push;
  }
  return side;
}

/// Whether a point at this offset from the corner is too deep for contact.
template <int Dim>
[[nodiscard]] bool too_deep(const PairDefinition<Dim>& pair, const std::array<Vec<Dim>, 2>& normal,
                            const Vec<Dim>& offset) {
  return std::min(offset.dot(normal[0]), offset.dot(normal[1])) < -pair.depth;
}

}  // namespace osculate::pairing
