#include "osculate/model/small_strain.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/core/dense.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/material_memory.hpp"

namespace osculate::model {
namespace {

/// Gradient of the displacements over one cell; zero where the nodes span no volume.
template <int Dim>
Mat<Dim, Dim> mean_gradient(const CellPlaces<Dim>& cell) {
  const Vec<Dim> middle = cell.reference.colwise().mean().transpose();
  const Vec<Dim> way = cell.displacement.colwise().mean().transpose();
  Mat<Dim, Dim> spread = Mat<Dim, Dim>::Zero(), carried = spread;
  for (Eigen::Index n = 0; n < cell.reference.rows(); ++n) {
    const Vec<Dim> arm = cell.reference.row(n).transpose() - middle;
    spread += arm * arm.transpose();
    carried += (cell.displacement.row(n).transpose() - way) * arm.transpose();
  }
  const Mat<Dim, Dim> gradient = carried * spread.inverse();
  return gradient.allFinite() ? gradient : Mat<Dim, Dim>(Mat<Dim, Dim>::Zero());
}

double rotation_of(const Mat<2, 2>& f) {
  return std::abs(std::atan2(f(1, 0) - f(0, 1), f.trace()));
}

double rotation_of(const Mat<3, 3>& f) {
  constexpr double small = 0.05;
  const Vec3 axis = 0.5 * Vec3(f(2, 1) - f(1, 2), f(0, 2) - f(2, 0), f(1, 0) - f(0, 1));
  if (axis.norm() < small && f.trace() > 1) return axis.norm();
  const core::SingularValues svd = core::singular_values(f);
  const Mat<3, 3> v = svd.v;
  if (!(svd.values.minCoeff() > 0)) return std::numbers::pi;
  const Mat<3, 3> r = f * v * svd.values.cwiseInverse().asDiagonal() * v.transpose();
  return std::acos(std::clamp(0.5 * (r.trace() - 1), -1.0, 1.0));
}

}  // namespace

template <int Dim>
void measure_small_strain(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                          std::vector<SmallStrain>& found) {
  std::vector<std::size_t> entry_of(model.sections.size());
  std::size_t entries = 0;
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const BasicBulkSection<Dim>& section = model.sections[s];
    if (section.section.kinematics != solid::Kinematics::small) continue;
    entry_of[s] = entries++;
    if (found.size() < entries) found.push_back({section.name});
    found[entry_of[s]].may_be_finite = material::has_finite_form(section.section.law);
  }
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    if (section.section.kinematics != solid::Kinematics::small || m.removed) return;
    SmallStrain& here = found[entry_of[static_cast<std::size_t>(&section - model.sections.data())]];
    const Mat<Dim, Dim> f =
        Mat<Dim, Dim>::Identity() +
        mean_gradient<Dim>(places_of(model, section, cell_nodes(model.mesh, ref).nodes, state.u,
                                     m.of(state.memory)));
    const Mat<Dim, Dim> strain = 0.5 * (f.transpose() * f - Mat<Dim, Dim>::Identity());
    here.strain = std::max(here.strain, strain.norm());
    here.rotation = std::max(here.rotation, rotation_of(f));
  });
}

std::string left_small_strain(const SmallStrain& found) {
  if (!found.large()) return {};
  return fmt::format(
      "warning: section '{}' is computed with small strains, but has strains up to {:.2g} % and "
      "rotations up to {:.2g} degrees, which they are not for: give it {}",
      found.section, 100 * found.strain, found.rotation * 180 / std::numbers::pi,
      found.may_be_finite
          ? "kinematics: finite"
          : "a material of large rotations (st_venant_kirchhoff) or strains (neo_hooke)");
}

template void measure_small_strain(const Model&, const State&, std::vector<SmallStrain>&);
template void measure_small_strain(const Model3&, const State3&, std::vector<SmallStrain>&);

}  // namespace osculate::model
