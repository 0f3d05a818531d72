// Stresses and strains that bodies have before the first step.
#include <fmt/format.h>

#include <Eigen/LU>

#include "osculate/deck/build_cells.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/solid/point_axes.hpp"

namespace osculate::deck {
namespace {

/// Components of the model file in the order of the strains, shears doubled where they are strains:
/// xx, yy, zz, xy and, in space, yz, xz.
template <int Dim>
Vec<solid::components<Dim>> ordered(const std::vector<double>& given, const core::SourceMark& mark,
                                    bool strain) {
  constexpr std::size_t count = solid::components<Dim>;
  if (given.size() != count)
    throw core::InputError(
        mark, fmt::format("expected {} components, {}, got {}", count,
                          Dim == 2 ? "xx, yy, zz, xy" : "xx, yy, zz, xy, xz, yz", given.size()));
  Vec<solid::components<Dim>> out;
  for (std::size_t i = 0; i < count; ++i) out[static_cast<Eigen::Index>(i)] = given[i];
  if constexpr (Dim == 3) std::swap(out[4], out[5]);
  if (strain) out.template tail<solid::components<Dim> - 3>() *= 2;
  return out;
}

/// Adds to the strains of one cell.
template <int Dim>
void add_to_cell(const InitialState& initial, bool strain, const solid::Section<Dim>& section,
                 cell::CellType type, const solid::Coordinates<Dim>& reference,
                 std::vector<double>& cell) {
  const auto stiffness = solid::unloaded_stiffness(section, type, reference);
  cell.resize(6 * stiffness.size(), 0.0);
  const auto add = [&](std::size_t point, const std::vector<double>& given,
                       const core::SourceMark& mark) {
    Vec<solid::components<Dim>> e = ordered<Dim>(given, mark, strain);
    e = strain ? Vec<solid::components<Dim>>(-e)
               : Vec<solid::components<Dim>>(stiffness[point].partialPivLu().solve(e));
    for (Eigen::Index i = 0; i < e.size(); ++i)
      cell[6 * point + static_cast<std::size_t>(i)] += e[i];
  };
  if (initial.points.value.empty()) {
    for (std::size_t p = 0; p < stiffness.size(); ++p)
      add(p, initial.value.value, initial.value.mark);
    return;
  }
  const solid::Coordinates<Dim> still = solid::Coordinates<Dim>::Zero(reference.rows(), Dim);
  const std::vector<std::size_t> order =
      solid::in_order(solid::stress_at_points(section, type, reference, still));
  if (initial.points.value.size() > order.size())
    throw core::InputError(initial.points.mark,
                           fmt::format("a cell of '{}' has {} points, not {}", initial.on.value,
                                       order.size(), initial.points.value.size()));
  for (std::size_t i = 0; i < initial.points.value.size(); ++i)
    add(order[i], initial.points.value[i], initial.points.mark);
}

/// In plane stress there is none across the plane.
void require_none_across(const InitialState& initial, const solid::Section<2>& section,
                         bool strain) {
  if (strain || section.assumption != solid::Assumption::plane_stress) return;
  const auto across = [](const std::vector<double>& s) { return s.size() > 2 && s[2] != 0; };
  bool any = across(initial.value.value);
  for (const std::vector<double>& s : initial.points.value) any = any || across(s);
  if (any)
    throw core::InputError(initial.on.mark, "in plane stress the stress zz is 0, also at first");
}
void require_none_across(const InitialState&, const solid::Section<3>&, bool) {}

template <int Dim>
void add_initial(BuildContext<Dim>& c, const InitialState& initial, bool strain) {
  model::BasicModel<Dim>& m = c.model();
  for (const auto& part : cells_on(c, initial.on)) {
    model::BasicBulkSection<Dim>& section = m.sections[part.section];
    require_hooke(section.section, c.description.sections[part.section].on.value, initial.on.mark);
    require_none_across(initial, section.section, strain);
    section.initial.resize(section.cells.size());
    for (const std::size_t i : part.cells) {
      const model::CellNodes cell = model::cell_nodes(m.mesh, section.cells[i]);
      add_to_cell(initial, strain, model::section_on(section, cell.type), cell.type,
                  model::reference_of(m, cell.nodes), section.initial[i]);
    }
  }
}

}  // namespace

template <int Dim>
void require_hooke(const solid::Section<Dim>& section, const std::string& on,
                   const core::SourceMark& mark) {
  const bool finite = section.kinematics == solid::Kinematics::finite;
  if (material::over_temperature(section.law))
    throw core::InputError(mark,
                           "initial stresses and strains do not go with constants that depend on "
                           "the temperature");
  if (!material::hooke_at_first(section.law))
    throw core::InputError(
        mark, fmt::format("the section on '{}' is of {}{}: initial stresses and strains are for "
                          "linear_elastic, orthotropic, anisotropic and, with small strains, "
                          "elastoplastic and norton",
                          on, material::key_of(section.law), finite ? " with finite strains" : ""));
  if (section.formulation == solid::Formulation::solid_shell)
    throw core::InputError(mark, "initial stresses and strains are not for solid_shell");
  if (finite && material::strains_of(section.expansion) > 0)
    throw core::InputError(mark,
                           "initial stresses and strains do not go with finite strains and an "
                           "expansion");
}

template <int Dim>
void build_initial_state(BuildContext<Dim>& c) {
  for (const InitialState& one : c.description.initial_stress) add_initial(c, one, false);
  for (const InitialState& one : c.description.initial_strain) add_initial(c, one, true);
}

template void require_hooke(const solid::Section<2>&, const std::string&, const core::SourceMark&);
template void require_hooke(const solid::Section<3>&, const std::string&, const core::SourceMark&);
template void build_initial_state(BuildContext<2>&);
template void build_initial_state(BuildContext<3>&);

}  // namespace osculate::deck
