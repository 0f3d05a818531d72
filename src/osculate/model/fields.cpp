#include "osculate/model/fields.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/model/material_memory.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::model {
namespace {

template <std::size_t N>
double mises_of(const std::array<double, N>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  double shear = 0;
  for (std::size_t i = 3; i < N; ++i) shear += s[i] * s[i];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
}

template <int Dim>
void add_cell(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
              const mesh::CellRef& ref, const BasicState<Dim>& state, const CellMemory& memory,
              BasicNodalFields<Dim>& f, std::vector<int>& count) {
  const CellNodes cell = cell_nodes(model.mesh, ref);
  const material::Memory of = memory.of(state.memory);
  const CellPlaces<Dim> at = places_of(model, section, cell.nodes, state.u, of);
  const auto s = solid::nodal_stress(section_on(section, cell.type), cell.type, at.reference,
                                     at.displacement, of);
  for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(cell.nodes[k]);
    ++count[node];
    for (std::size_t i = 0; i < f.stress[node].size(); ++i) {
      f.stress[node][i] += s.stress[k][static_cast<Eigen::Index>(i)];
      f.strain[node][i] += s.strain[k][static_cast<Eigen::Index>(i)];
    }
  }
}

/// Values at the nodes as those of the stress; what cannot be negative is not.
template <int Dim>
void add_memory(const BasicModel<Dim>& model, const BasicBulkSection<Dim>& section,
                const mesh::CellRef& ref, std::span<const double> state, const CellMemory& memory,
                BasicNodalFields<Dim>& f) {
  if (memory.size == 0) return;
  const CellNodes cell = cell_nodes(model.mesh, ref);
  const auto numbers = static_cast<Eigen::Index>(memory.size);
  const Eigen::MatrixXd nodal =
      solid::at_nodes(section_on(section, cell.type), cell.type,
                      Eigen::Map<const Eigen::MatrixXd>(state.data() + memory.first, numbers,
                                                        static_cast<Eigen::Index>(memory.points))
                          .transpose());
  const std::span<const material::Remembered> names = material::memory_of(section.section.law);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].name.empty()) continue;
    auto field =
        std::ranges::find(f.memory, names[i].name, [](const auto& of) { return of.first; });
    if (field == f.memory.end())
      field = f.memory.insert(field, {names[i].name, std::vector<double>(f.mises.size(), 0.0)});
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      const double value = nodal(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i));
      field->second[static_cast<std::size_t>(cell.nodes[k])] +=
          names[i].negative ? value : std::max(value, 0.0);
    }
  }
}

}  // namespace

template <int Dim>
BasicNodalFields<Dim> nodal_fields(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                   const BasicState<Dim>& state) {
  const std::size_t n = model.mesh.nodes.size();
  BasicNodalFields<Dim> f;
  f.displacement.resize(n);
  f.reaction.resize(n);
  f.stress.assign(n, {});
  f.strain.assign(n, {});
  f.mises.assign(n, 0.0);
  const Eigen::VectorXd reaction = reactions(system);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Index first = Dim * static_cast<Eigen::Index>(i);
    f.displacement[i] = state.u.template segment<Dim>(first);
    f.reaction[i] = reaction.segment<Dim>(first);
  }
  std::vector<int> count(n, 0);
  const BasicModel<Dim>& now = system.model();
  for_each_cell(now, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    if (m.removed) return;
    add_cell(model, section, ref, state, m, f, count);
    add_memory(model, section, ref, state.memory, m, f);
  });
  for (std::size_t i = 0; i < n; ++i) {
    if (count[i] == 0) continue;
    for (std::size_t c = 0; c < f.stress[i].size(); ++c) {
      f.stress[i][c] /= count[i];
      f.strain[i][c] /= count[i];
    }
    f.mises[i] = mises_of(f.stress[i]);
    for (auto& field : f.memory) field.second[i] /= count[i];
  }
  return f;
}

template <int Dim>
std::vector<double> nodal_work(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                               const BasicState<Dim>& state) {
  std::vector<double> work(model.mesh.nodes.size(), 0.0);
  std::vector<int> count(work.size(), 0);
  for_each_cell(system.model(), [&](const auto& section, const mesh::CellRef& ref,
                                    const CellMemory& m) {
    if (m.removed) return;
    const CellNodes cell = cell_nodes(model.mesh, ref);
    const material::Memory of = m.of(state.memory);
    const CellPlaces<Dim> at = places_of(model, section, cell.nodes, state.u, of);
    const solid::Section<Dim>& here = section_on(section, cell.type);
    const auto stress = solid::stress_at_points(here, cell.type, at.reference, at.displacement, of);
    const auto energies = solid::point_energies<Dim>(here, cell.type, at.reference, stress, of);
    Eigen::VectorXd of_points(stress.count);
    for (Eigen::Index p = 0; p < of_points.size(); ++p) {
      const solid::CellEnergy& energy = energies[static_cast<std::size_t>(p)];
      of_points[p] = energy.stored + energy.dissipated;
    }
    const Eigen::MatrixXd nodal = solid::at_nodes(here, cell.type, of_points);
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      ++count[static_cast<std::size_t>(cell.nodes[k])];
      work[static_cast<std::size_t>(cell.nodes[k])] += nodal(static_cast<Eigen::Index>(k), 0);
    }
  });
  for (std::size_t i = 0; i < work.size(); ++i)
    if (count[i] > 0) work[i] /= count[i];
  return work;
}

template <int Dim>
double largest_remembered(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                          std::span<const Index> nodes, std::string_view name) {
  BasicNodalFields<Dim> f;
  f.mises.assign(model.mesh.nodes.size(), 0.0);
  std::vector<int> count(model.mesh.nodes.size(), 0);
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    if (m.removed) return;
    for (const Index node : cell_nodes(model.mesh, ref).nodes)
      ++count[static_cast<std::size_t>(node)];
    add_memory(model, section, ref, state.memory, m, f);
  });
  const auto field = std::ranges::find(f.memory, name, [](const auto& of) { return of.first; });
  double largest = 0;
  if (field == f.memory.end()) return largest;
  for (const Index node : nodes) {
    const auto n = static_cast<std::size_t>(node);
    const double value = count[n] > 0 ? field->second[n] / count[n] : 0;
    if (std::abs(value) > std::abs(largest)) largest = value;
  }
  return largest;
}

template NodalFields nodal_fields(const System&, const Model&, const State&);
template NodalFields3 nodal_fields(const System3&, const Model3&, const State3&);
template std::vector<double> nodal_work(const System&, const Model&, const State&);
template std::vector<double> nodal_work(const System3&, const Model3&, const State3&);
template double largest_remembered(const Model&, const State&, std::span<const Index>,
                                   std::string_view);
template double largest_remembered(const Model3&, const State3&, std::span<const Index>,
                                   std::string_view);

}  // namespace osculate::model
