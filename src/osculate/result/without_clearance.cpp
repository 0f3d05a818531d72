#include "osculate/result/without_clearance.hpp"

#include <fmt/format.h>

#include "osculate/mesh/boundary.hpp"
#include "osculate/pairing/placed_points.hpp"

namespace osculate::result {

template <int Dim>
std::string without_clearance(const model::BasicModel<Dim>& model,
                              const model::BasicContactPair<Dim>& pair,
                              const pairing::PairEvaluation<Dim>& contact,
                              const pairing::PairState<Dim>& state) {
  if (pair.definition.overlap != pairing::InitialOverlap::given) return {};
  std::vector<std::size_t> found;  // nothing was taken off their gaps
  for (std::size_t i = 0; i < std::min(contact.points.size(), state.overlap.size()); ++i)
    if (contact.points[i].status != contact::Status::open && state.overlap[i] == 0)
      found.push_back(i);
  if (found.empty()) return {};
  const std::vector<bool> placed = pairing::placed_points<Dim>(pair.definition, model.reference);
  std::erase_if(found, [&](std::size_t i) { return placed[i]; });
  if (found.empty()) return {};
  return fmt::format(
      "warning: contact '{}': {} points are in contact that had no place on the master at the "
      "start, and so no clearance: their gaps are those of the mesh (the first: {})",
      pair.name, found.size(),
      mesh::describe_node(model.mesh, pair.definition.slave.points[found.front()].nearest_node()));
}

template std::string without_clearance(const model::Model&, const model::ContactPair&,
                                       const pairing::PairEvaluation<2>&,
                                       const pairing::PairState<2>&);
template std::string without_clearance(const model::Model3&, const model::ContactPair3&,
                                       const pairing::PairEvaluation<3>&,
                                       const pairing::PairState<3>&);

}  // namespace osculate::result
