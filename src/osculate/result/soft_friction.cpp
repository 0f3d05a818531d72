#include "osculate/result/soft_friction.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/model/penetration.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::result {

template <int Dim>
void measure_sticking(const model::BasicContactPair<Dim>& pair,
                      const pairing::PairEvaluation<Dim>& contact, Penetration& found) {
  const pairing::PairDefinition<Dim>& definition = pair.definition;
  if (!definition.friction || !pairing::is<pairing::ByPenalty>(definition.enforcement)) return;
  double give = 0;
  const std::size_t count = std::min(contact.points.size(), definition.slave.points.size());
  for (std::size_t i = 0; i < count; ++i) {
    const pairing::PointResult<Dim>& point = contact.points[i];
    const double penalty = pairing::point_penalty(definition, i).shear;
    if (point.status == contact::Status::open || !(penalty > 0)) continue;
    const double own = point.shear_traction.norm() / penalty;
    const double height = model::height_behind(pair, i);
    give += own;
    found.way += point.slip_increment.norm();
    if (height > 0) found.give_share = std::max(found.give_share, own / height);
  }
  if (!(give > found.give)) return;
  found.give = give;
  found.way_of_give = found.way;
}

template <int Dim>
std::string soft_friction(const model::BasicContactPair<Dim>& pair, const Penetration& found) {
  constexpr double far = 0.5, most = 0.5;  // of a cell, of the way
  const double share = found.way_of_give > 0 ? std::min(1.0, found.give / found.way_of_give) : 0;
  if (!(found.give_share > far) || !(share > most)) return {};
  return fmt::format(
      "warning: contact '{}': {:.2g} of the way that its points slid is the give of the friction "
      "penalty, up to {:.2g} of the height of the cells: the shear is too small; a friction "
      "penalty "
      "of {:.3g} would give way by a hundredth of a cell",
      pair.name, share, found.give_share,
      contact::stiffness(*pair.definition.friction) * found.give_share / 0.01);
}

template void measure_sticking(const model::ContactPair&, const pairing::PairEvaluation<2>&,
                               Penetration&);
template void measure_sticking(const model::ContactPair3&, const pairing::PairEvaluation<3>&,
                               Penetration&);
template std::string soft_friction(const model::ContactPair&, const Penetration&);
template std::string soft_friction(const model::ContactPair3&, const Penetration&);

}  // namespace osculate::result
