#include "osculate/model/small_strain.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/core/dense.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::model {
namespace {

/// Gradient of the displacements over one cell; zero where the nodes span no volume.
template <int Dim>
Mat<Dim, Dim> mean_gradient(const std::vector<Vec<Dim>>& reference, const Eigen::VectorXd& u,
                            std::span<const Index> nodes) {
  const auto at = [&](Index n) -> const Vec<Dim>& {
    return reference[static_cast<std::size_t>(n)];
  };
  const auto moved = [&](Index n) -> Vec<Dim> {
    return u.template segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  };
  Vec<Dim> middle = Vec<Dim>::Zero(), way = Vec<Dim>::Zero();
  for (const Index n : nodes) {
    middle += at(n);
    way += moved(n);
  }
  middle /= static_cast<double>(nodes.size());
  way /= static_cast<double>(nodes.size());
  Mat<Dim, Dim> spread = Mat<Dim, Dim>::Zero(), carried = spread;
  for (const Index n : nodes) {
    const Vec<Dim> arm = at(n) - middle;
    spread += arm * arm.transpose();
    carried += (moved(n) - way) * arm.transpose();
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
void measure_small_strain(const BasicModel<Dim>& model, const Eigen::VectorXd& u,
                          std::vector<SmallStrain>& found) {
  std::size_t entry = 0;
  for (const BasicBulkSection<Dim>& section : model.sections) {
    if (section.section.kinematics != solid::Kinematics::small) continue;
    if (found.size() <= entry) found.push_back({section.name});
    SmallStrain& here = found[entry++];
    here.may_be_finite = material::has_finite_form(section.section.law);
    for (std::size_t i = 0; i < section.cells.size(); ++i) {
      if (is_removed(section, i)) continue;
      const Mat<Dim, Dim> f =
          Mat<Dim, Dim>::Identity() +
          mean_gradient<Dim>(model.reference, u, cell_nodes(model.mesh, section.cells[i]).nodes);
      const Mat<Dim, Dim> strain = 0.5 * (f.transpose() * f - Mat<Dim, Dim>::Identity());
      here.strain = std::max(here.strain, strain.norm());
      here.rotation = std::max(here.rotation, rotation_of(f));
    }
  }
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

template void measure_small_strain(const BasicModel<2>&, const Eigen::VectorXd&,
                                   std::vector<SmallStrain>&);
template void measure_small_strain(const BasicModel<3>&, const Eigen::VectorXd&,
                                   std::vector<SmallStrain>&);

}  // namespace osculate::model
