#include "osculate/model/small_strain.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "osculate/core/dense.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/material_memory.hpp"

namespace osculate::model {
namespace {

/// Gradient of the displacements over one cell, and how large it is of nodes that move by 1; zero
/// where the nodes span no volume.
template <int Dim>
std::pair<Mat<Dim, Dim>, double> mean_gradient(const CellPlaces<Dim>& cell) {
  const Vec<Dim> middle = cell.reference.colwise().mean().transpose();
  const Vec<Dim> way = cell.displacement.colwise().mean().transpose();
  Mat<Dim, Dim> spread = Mat<Dim, Dim>::Zero(), carried = spread;
  for (Eigen::Index n = 0; n < cell.reference.rows(); ++n) {
    const Vec<Dim> arm = cell.reference.row(n).transpose() - middle;
    spread += arm * arm.transpose();
    carried += (cell.displacement.row(n).transpose() - way) * arm.transpose();
  }
  const Mat<Dim, Dim> inverse = spread.inverse();
  const Mat<Dim, Dim> gradient = carried * inverse;
  const double per_motion = std::sqrt(static_cast<double>(cell.reference.rows()) * inverse.trace());
  if (!gradient.allFinite() || !std::isfinite(per_motion)) return {Mat<Dim, Dim>::Zero(), 0.0};
  return {gradient, per_motion};
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
bool SmallStrainBound<Dim>::holds(const Eigen::VectorXd& displacements) const {
  constexpr double limit = 0.09;
  if (!(gradient <= limit)) return false;
  Vec<Dim> least = Vec<Dim>::Zero(), most = least;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec<Dim> by = displacements.template segment<Dim>(Dim * nodes[i]) -
                        u.template segment<Dim>(Dim * static_cast<Eigen::Index>(i));
    least = i == 0 ? by : least.cwiseMin(by).eval();
    most = i == 0 ? by : most.cwiseMax(by).eval();
  }
  return gradient + per_motion * (most - least).norm() / 2 <= limit;
}

namespace {

template <int Dim>
void set_places(const BasicState<Dim>& state, SmallStrainBound<Dim>& bound) {
  bound.u.resize(Dim * static_cast<Eigen::Index>(bound.nodes.size()));
  for (std::size_t i = 0; i < bound.nodes.size(); ++i)
    bound.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
        state.u.template segment<Dim>(Dim * bound.nodes[i]);
}

}  // namespace

template <int Dim>
void measure_small_strain(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                          std::vector<SmallStrain>& found,
                          std::vector<SmallStrainBound<Dim>>* bounds) {
  std::vector<std::size_t> entry_of(model.sections.size());
  std::size_t entries = 0;
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const BasicBulkSection<Dim>& section = model.sections[s];
    if (section.section.kinematics != solid::Kinematics::small) continue;
    entry_of[s] = entries++;
    if (found.size() < entries) found.push_back({section.name});
    found[entry_of[s]].may_be_finite = material::has_finite_form(section.section.law);
  }
  if (bounds) bounds->assign(entries, {});
  std::vector<std::size_t> named_by(bounds ? model.mesh.nodes.size() : 0, entries);
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    if (section.section.kinematics != solid::Kinematics::small || m.removed) return;
    const std::size_t entry = entry_of[static_cast<std::size_t>(&section - model.sections.data())];
    SmallStrain& here = found[entry];
    const std::span<const Index> nodes = cell_nodes(model.mesh, ref).nodes;
    const auto [gradient, per_motion] =
        mean_gradient<Dim>(places_of(model, section, nodes, state.u, m.of(state.memory)));
    const Mat<Dim, Dim> f = Mat<Dim, Dim>::Identity() + gradient;
    const Mat<Dim, Dim> strain = 0.5 * (f.transpose() * f - Mat<Dim, Dim>::Identity());
    here.strain = std::max(here.strain, strain.norm());
    here.rotation = std::max(here.rotation, rotation_of(f));
    if (!bounds) return;
    SmallStrainBound<Dim>& bound = (*bounds)[entry];
    bound.gradient = std::max(bound.gradient, gradient.norm());
    bound.per_motion = std::max(bound.per_motion, per_motion);
    for (const Index n : nodes)  // sections are visited one after the other
      if (std::exchange(named_by[static_cast<std::size_t>(n)], entry) != entry)
        bound.nodes.push_back(n);
  });
  if (bounds)
    for (SmallStrainBound<Dim>& bound : *bounds) set_places(state, bound);
}

template <int Dim>
void SmallStrainWatch<Dim>::take(const BasicModel<Dim>& model, int step,
                                 const BasicState<Dim>& state, std::vector<SmallStrain>& found) {
  if (step == step_ && std::ranges::all_of(bounds_, [&](const SmallStrainBound<Dim>& bound) {
        return bound.holds(state.u);
      }))
    return;
  step_ = step;
  ++measured_;
  std::vector<SmallStrain> now;
  measure_small_strain(model, state, now, &bounds_);
  found.resize(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    found[i].section = now[i].section;
    found[i].may_be_finite = now[i].may_be_finite;
    if (!now[i].large()) continue;
    found[i].strain = std::max(found[i].strain, now[i].strain);
    found[i].rotation = std::max(found[i].rotation, now[i].rotation);
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

template struct SmallStrainBound<2>;
template struct SmallStrainBound<3>;
template class SmallStrainWatch<2>;
template class SmallStrainWatch<3>;
template void measure_small_strain(const Model&, const State&, std::vector<SmallStrain>&,
                                   std::vector<SmallStrainBound<2>>*);
template void measure_small_strain(const Model3&, const State3&, std::vector<SmallStrain>&,
                                   std::vector<SmallStrainBound<3>>*);

}  // namespace osculate::model
