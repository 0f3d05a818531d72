#include "osculate/result/body_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/mesh/boundary.hpp"

namespace osculate::result {

template <int Dim>
BodyNumbers body_numbers(const model::BasicModel<Dim>& model) {
  BodyNumbers bodies;
  const auto of = [&](const mesh::CellRef& ref) -> Index& {
    return bodies.of_cell[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)];
  };
  for (const mesh::Block& block : model.mesh.blocks)
    bodies.of_cell.emplace_back(static_cast<std::size_t>(block.size()), -1);
  std::vector<mesh::CellRef> cells;
  for (std::size_t s = 0; s < model.sections.size(); ++s)
    for (const mesh::CellRef& ref : model.sections[s].cells) {
      of(ref) = static_cast<Index>(s);
      cells.push_back(ref);
    }
  for (const auto& part : mesh::connected_parts(model.mesh, cells)) {
    bodies.names.push_back(model.sections[static_cast<std::size_t>(of(part[0]))].name);
    for (const mesh::CellRef& ref : part) of(ref) = static_cast<Index>(bodies.deformable);
    ++bodies.deformable;
  }
  const std::vector<std::string> sections = bodies.names;
  for (std::size_t b = 0; b < sections.size(); ++b)
    if (std::count(sections.begin(), sections.end(), sections[b]) > 1)
      bodies.names[b] += fmt::format(" ({})", b + 1);
  for (const model::BasicRigidBody<Dim>& rigid : model.rigid) bodies.names.push_back(rigid.name);
  return bodies;
}

template BodyNumbers body_numbers(const model::Model&);
template BodyNumbers body_numbers(const model::Model3&);

}  // namespace osculate::result
