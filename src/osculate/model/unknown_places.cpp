#include "osculate/model/unknown_places.hpp"

#include "osculate/model/marks.hpp"

namespace osculate::model {

template <int Dim>
la::Places unknown_places(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                          Index multipliers) {
  Marks<Dim> marks{model, dofs};
  mark_contact(model, marks);
  mark_connectors(model, marks);
  const auto n = static_cast<std::size_t>(dofs.unknowns() + multipliers);
  la::Places out;
  out.dimension = Dim;
  out.node.assign(n, -1);
  out.direction.assign(n, 0);
  out.place.assign(n, Vec3::Zero());
  out.exact = std::move(marks.of_unknown);
  out.exact.resize(n, 1);
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    const Dof dof = dofs.dof_of_unknown(u);
    if (dof >= Dim * dofs.nodes()) continue;
    const auto i = static_cast<std::size_t>(u);
    out.node[i] = dof / Dim;
    out.direction[i] = dof % Dim;
    out.place[i].template head<Dim>() = model.reference[static_cast<std::size_t>(dof / Dim)];
  }
  return out;
}

template la::Places unknown_places(const Model&, const DofSpace&, Index);
template la::Places unknown_places(const Model3&, const DofSpace3&, Index);

}  // namespace osculate::model
