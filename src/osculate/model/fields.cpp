#include "osculate/model/fields.hpp"

#include <cmath>

#include "osculate/model/bulk.hpp"
#include "osculate/model/quantities.hpp"

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
              const mesh::CellRef& ref, const BasicState<Dim>& state, BasicNodalFields<Dim>& f,
              std::vector<int>& count) {
  const CellNodes cell = cell_nodes(model.mesh, ref);
  const auto s = solid::nodal_stress(section_on(section, cell.type), cell.type,
                                     reference_of(model, cell.nodes),
                                     displacement_of<Dim>(state.u, cell.nodes));
  for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(cell.nodes[k]);
    ++count[node];
    for (std::size_t i = 0; i < f.stress[node].size(); ++i) {
      f.stress[node][i] += s.stress[k][static_cast<Eigen::Index>(i)];
      f.strain[node][i] += s.strain[k][static_cast<Eigen::Index>(i)];
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
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (const mesh::CellRef& ref : section.cells) add_cell(model, section, ref, state, f, count);
  for (std::size_t i = 0; i < n; ++i) {
    if (count[i] == 0) continue;
    for (std::size_t c = 0; c < f.stress[i].size(); ++c) {
      f.stress[i][c] /= count[i];
      f.strain[i][c] /= count[i];
    }
    f.mises[i] = mises_of(f.stress[i]);
  }
  return f;
}

template NodalFields nodal_fields(const System&, const Model&, const State&);
template NodalFields3 nodal_fields(const System3&, const Model3&, const State3&);

}  // namespace osculate::model
