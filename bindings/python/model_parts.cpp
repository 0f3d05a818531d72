// A model before its analysis: what `osculate.plot_model` draws.
#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "convert.hpp"
#include "data_sets.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/system.hpp"
#include "osculate/result/field_files.hpp"

namespace osculate::python {
namespace {

/// Corners of a facet: two in the plane, three or four in space.
std::vector<Index> corners(const pairing::Facet& facet) { return {facet.nodes[0], facet.nodes[1]}; }
std::vector<Index> corners(const pairing::SurfaceFacet& facet) {
  const std::size_t count = cell::info(facet.type).name.starts_with("tri") ? 3 : 4;
  return {facet.nodes.begin(), facet.nodes.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// A 1 for each component of a node that the first step prescribes.
template <int Dim>
io::Field held(const model::BasicModel<Dim>& model) {
  io::Field field{"held", 3, std::vector<double>(3 * model.mesh.nodes.size()), {}};
  if (model.steps.empty()) return field;
  for (const model::PrescribedDof& one : model.steps.front().prescribed) {
    const auto dof = static_cast<std::size_t>(one.dof);
    if (dof / Dim < model.mesh.nodes.size()) field.values[3 * (dof / Dim) + dof % Dim] = 1;
  }
  return field;
}

template <int Dim>
py::tuple parts(const deck::BasicBuilt<Dim>& built) {
  const model::BasicModel<Dim>& model = built.model;
  model::BasicSystem<Dim> system(model, 1);
  result::BodyCells bodies = result::body_cells(model);
  io::Field still{"U", 3, std::vector<double>(3 * model.mesh.nodes.size()), {}};
  py::list sets;
  sets.append(data_set({"bodies",
                        model.mesh.nodes,
                        std::move(bodies.blocks),
                        {std::move(still), held(model)},
                        std::move(bodies.fields)}));
  if (!model.rigid.empty()) {
    const std::conditional_t<Dim == 2, result::RigidLines, result::RigidFaces> rigid(model);
    sets.append(
        data_set(result::rigid_set(model, rigid, system.initial_state(), bodies.deformable)));
  }
  py::dict slaves;
  for (const auto& pair : model.pairs) {
    py::list facets;
    for (const auto& facet : pair.definition.slave.boundary.facets) facets.append(corners(facet));
    slaves[py::str(pair.name)] = facets;
  }
  py::list names;
  for (const auto& section : model.sections) names.append(section.name);
  return py::make_tuple(sets, slaves, names);
}

}  // namespace

void add_model_parts(py::module_& m) {
  m.def("model_parts", [](const std::string& model, const py::object& document,
                          const std::vector<std::pair<std::string, std::string>>& given) {
    std::vector<deck::Setting> settings;
    for (const auto& [name, value] : given) settings.push_back({name, value});
    const deck::Description description =
        document.is_none() ? deck::read_model(model, settings)
                           : deck::parse_model(source_of(document, model), model, settings);
    return std::visit([](const auto& built) { return parts(built); },
                      deck::build_any(description, deck::load_mesh(description)));
  });
}

}  // namespace osculate::python
