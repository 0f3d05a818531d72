#include "osculate/model/onto_master.hpp"

#include <cmath>

namespace osculate::model {

template <int Dim>
std::vector<MovedNode<Dim>> onto_master(pairing::PairDefinition<Dim>& pair,
                                        const std::vector<Vec<Dim>>& reference, double tolerance) {
  const std::span<const Vec<Dim>> x(reference);
  pairing::prepare<Dim>(pair, x);
  pairing::PairEvaluation<Dim> found;
  pairing::evaluate<Dim>(pair, x, pairing::initial_state<Dim>(pair, x), false, found);
  std::vector<MovedNode<Dim>> moved;
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const pairing::PointResult<Dim>& point = found.points[i];
    const bool inside = point.status != contact::Status::open && point.gap < 0;
    if (!inside && !(std::abs(point.gap) <= tolerance)) continue;
    const Index node = pair.slave.points[i].nearest_node();
    const Vec<Dim> way = point.foot - reference[static_cast<std::size_t>(node)];
    moved.push_back({node, point.foot, way.norm()});
  }
  return moved;
}

template std::vector<MovedNode<2>> onto_master(pairing::PairDefinition<2>&,
                                               const std::vector<Vec2>&, double);
template std::vector<MovedNode<3>> onto_master(pairing::PairDefinition<3>&,
                                               const std::vector<Vec3>&, double);

}  // namespace osculate::model
