#include "osculate/model/fields.hpp"

#include <cmath>

#include "osculate/model/bulk.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::model {
namespace {

double mises_of(const std::array<double, 4>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * s[3] * s[3]);
}

}  // namespace

NodalFields nodal_fields(const System& system, const Model& model, const State& state) {
  const std::size_t n = model.mesh.nodes.size();
  NodalFields f;
  f.displacement.resize(n);
  f.reaction.resize(n);
  f.stress.assign(n, {});
  f.strain.assign(n, {});
  f.mises.assign(n, 0.0);
  const Eigen::VectorXd reaction = reactions(system);
  for (std::size_t i = 0; i < n; ++i) {
    f.displacement[i] = state.u.segment<2>(2 * static_cast<Eigen::Index>(i));
    f.reaction[i] = reaction.segment<2>(2 * static_cast<Eigen::Index>(i));
  }
  std::vector<int> count(n, 0);
  for (const BulkSection& section : model.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const CellNodes cell = cell_nodes(model, ref);
      const solid::NodalStress s =
          solid::nodal_stress(section.section, cell.type, reference_of(model, cell.nodes),
                              displacement_of(state.u, cell.nodes));
      for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
        const auto node = static_cast<std::size_t>(cell.nodes[k]);
        ++count[node];
        for (std::size_t i = 0; i < 4; ++i) {
          f.stress[node][i] += s.stress[k][static_cast<Eigen::Index>(i)];
          f.strain[node][i] += s.strain[k][static_cast<Eigen::Index>(i)];
        }
      }
    }
  for (std::size_t i = 0; i < n; ++i) {
    if (count[i] == 0) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      f.stress[i][c] /= count[i];
      f.strain[i][c] /= count[i];
    }
    f.mises[i] = mises_of(f.stress[i]);
  }
  return f;
}

}  // namespace osculate::model
