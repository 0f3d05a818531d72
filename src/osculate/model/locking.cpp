#include "osculate/model/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "osculate/model/bulk.hpp"
#include "osculate/model/material_memory.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::model {
namespace {

double poisson_of(const material::Law& law) { return material::unloaded(law).poisson; }

/// The same section with another formulation, or as it is where that is not made for its cells.
template <int Dim>
solid::Section<Dim> with(const solid::Section<Dim>& section, solid::Formulation formulation,
                         cell::CellType type) {
  solid::Section<Dim> other = section;
  other.formulation = formulation;
  return solid::unsupported(other, type).empty() ? other : section;
}

/// The section of cells of a type, and what it is compared with.
template <int Dim>
struct Compared {
  solid::Section<Dim> full, enhanced, bbar;
  bool any;  ///< these differ
};
template <int Dim>
Compared<Dim> compared(const BasicBulkSection<Dim>& section, cell::CellType type, bool flows) {
  using solid::Formulation;
  // Elsewhere volume changes are those of bending, as they should be.
  constexpr double nearly_incompressible = 0.45;
  const solid::Section<Dim> full = section_on(section, type);
  const bool keeps_volume = flows || poisson_of(full.law) > nearly_incompressible;
  Compared<Dim> out{full, full, full, false};
  if (full.formulation != Formulation::full) return out;
  if (!flows) out.enhanced = with(full, Formulation::enhanced, type);
  if (keeps_volume) out.bbar = with(full, Formulation::bbar, type);
  out.any = cell::info(type).order == 2 ? out.bbar.formulation != full.formulation
                                        : solid::volume_terms<Dim>(type) > 0;
  return out;
}

/// Energies of one wedge: all of it, what of it is of the shear between its top and its bottom and
/// of the stress across, and that of what its points have in common.
struct WedgeEnergy {
  double whole = 0, across = 0, mean = 0;
  /// As a plate of one layer does, which has neither; a layer of a thick body stretches,
  /// and one that is sheared alone has no other strain.
  [[nodiscard]] bool bends() const {
    const double bending = whole - mean;
    return bending > 1e-3 * across && bending > mean - across;
  }
};

/// Whether a wedge is less than half as high as its triangle is long; its normal.
bool is_thin(const solid::Coordinates<3>& x, Vec3& normal) {
  const Vec3 a = x.row(1) - x.row(0), b = x.row(2) - x.row(0);
  const Vec3 up = (x.bottomRows<3>().colwise().sum() - x.topRows<3>().colwise().sum()) / 3;
  const double side = std::sqrt(a.cross(b).norm());
  normal = a.cross(b).normalized();
  return std::abs(up.dot(normal)) < 0.5 * side;
}

/// Formula    shear: sum V (sigma n)_t . (epsilon n)_t , t: along the plate; across: sum V/2
///            sigma_nn^2 (1 + nu) (1 - 2 nu) / (E (1 - nu)) , what is less if the thickness may
///            change; in common: V/2 times the mean stress and strain
WedgeEnergy wedge_energy(const solid::Section<3>& section, const CellPlaces<3>& at,
                         const Vec3& normal, const material::Memory& memory) {
  const auto tensor = [](const Vec<6>& v) {
    Mat<3, 3> t;
    t << v[0], v[3], v[5], v[3], v[1], v[4], v[5], v[4], v[2];
    return t;
  };
  WedgeEnergy out;
  const solid::CellStress<3> cell = solid::stress_at_points(section, cell::CellType::wedge6,
                                                            at.reference, at.displacement, memory);
  const double young = material::unloaded(section.law).young, nu = poisson_of(section.law);
  const double give = (1 + nu) * (1 - 2 * nu) / (young * (1 - nu));
  double volume = 0;
  Mat<3, 3> stresses = Mat<3, 3>::Zero(), strains = Mat<3, 3>::Zero();
  for (std::size_t q = 0; q < static_cast<std::size_t>(cell.count); ++q) {
    const double part = cell.point[q].volume;
    const Mat<3, 3> stress = tensor(cell.point[q].stress), strain = tensor(cell.point[q].strain);
    const Vec3 pull = stress * normal, way = strain * normal;
    out.whole += 0.5 * part * stress.cwiseProduct(strain).sum();
    const double across = pull.dot(normal);
    out.across += part * (pull.dot(way) - across * way.dot(normal) + 0.5 * give * across * across);
    volume += part;
    stresses += part * stress;
    strains += part * strain;
  }
  out.mean = 0.5 * stresses.cwiseProduct(strains).sum() / volume;
  return out;
}

/// Adds the shear of a thin wedge that bends.
void add_wedge(const solid::Section<3>& section, cell::CellType type, const CellPlaces<3>& at,
               const material::Memory& memory, Locking& sum) {
  Vec3 normal;
  if (type != cell::CellType::wedge6 || !is_thin(at.reference, normal)) return;
  const WedgeEnergy energy = wedge_energy(section, at, normal, memory);
  if (!std::isfinite(energy.whole)) return;
  sum.wedges = true;
  sum.energy += energy.whole;
  sum.enhanced += energy.whole -
                  (energy.bends() ? std::clamp(energy.across, 0.0, std::abs(energy.whole)) : 0.0);
  sum.bbar += energy.whole;
}
void add_wedge(const solid::Section<2>&, cell::CellType, const CellPlaces<2>&,
               const material::Memory&, Locking&) {}

/// The cells of a section that can lock: of(compared, cell type, memory, places).
template <int Dim, class Of>
void for_each_plain(const BasicModel<Dim>& model, const BasicState<Dim>& state, std::size_t s,
                    const Of& of) {
  const BasicBulkSection<Dim>& wanted = model.sections[s];
  const bool flows = !material::memory_of(wanted.section.law).empty();
  std::map<cell::CellType, Compared<Dim>> types;
  for_each_cell(
      model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& memory) {
        if (&section != &wanted) return;
        const CellNodes cell = cell_nodes(model.mesh, ref);
        auto type = types.find(cell.type);
        if (type == types.end())
          type = types.emplace(cell.type, compared(section, cell.type, flows)).first;
        const Compared<Dim>& as = type->second;
        if (memory.removed || (!as.any && cell.type != cell::CellType::wedge6)) return;
        const material::Memory remembered = memory.of(state.memory);
        of(as, cell.type, remembered, places_of(model, section, cell.nodes, state.u, remembered));
      });
}

/// The energies of one section in one state, but for the floor.
template <int Dim>
Locking locking_of(const BasicModel<Dim>& model, const BasicState<Dim>& state, std::size_t s) {
  Locking sum;
  sum.flows = !material::memory_of(model.sections[s].section.law).empty();
  for_each_plain(model, state, s,
                 [&](const Compared<Dim>& as, cell::CellType type, const material::Memory& memory,
                     const CellPlaces<Dim>& at) {
                   if (!sum.flows) add_wedge(as.full, type, at, memory, sum);
                   if (!as.any) return;
                   const auto energy_in = [&](const solid::Section<Dim>& of) {
                     return solid::cell_energy(of, type, at.reference, at.displacement, memory);
                   };
                   const solid::CellEnergy plain = energy_in(as.full),
                                           mean = as.bbar.formulation == as.full.formulation
                                                      ? plain
                                                      : energy_in(as.bbar);
                   if (sum.flows && !(mean.dissipated > mean.stored)) return;
                   const double energy = plain.stored + plain.dissipated;
                   if (!std::isfinite(energy)) return;
                   const bool other = as.enhanced.formulation != as.full.formulation;
                   sum.energy += energy;
                   sum.enhanced += other ? std::min(energy_in(as.enhanced).stored, energy) : energy;
                   sum.bbar += std::min(mean.stored + mean.dissipated, energy);
                   sum.second = sum.second || cell::info(type).order == 2;
                 });
  return sum;
}

/// Energy of strains that are too small to be told from round-off.
template <int Dim>
double floor_of(const BasicModel<Dim>& model, const BasicState<Dim>& state, std::size_t s) {
  constexpr double visible = 1e-6;
  double floor = 0;
  for_each_plain(model, state, s,
                 [&](const Compared<Dim>& as, cell::CellType type, const material::Memory&,
                     const CellPlaces<Dim>& at) {
                   floor += solid::strain_energy(as.full, type, at.reference,
                                                 solid::Coordinates<Dim>(visible * at.reference));
                 });
  return floor;
}

}  // namespace

template <int Dim>
void measure_locking(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                     std::vector<Locking>& found) {
  found.resize(model.sections.size());
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const Locking here = locking_of(model, state, s);
    Locking& sum = found[s];
    sum.section = model.sections[s].name;
    sum.flows = here.flows;
    sum.wedges = sum.wedges || here.wedges;
    sum.second = sum.second || here.second;
    sum.energy += here.energy;
    sum.enhanced += here.enhanced;
    sum.bbar += here.bbar;
    // A sum is large only where one of its states is.
    if (here.large()) sum.floor += floor_of(model, state, s);
  }
}

std::string locks(const Locking& found) {
  if (!found.large()) return {};
  const bool volume = found.bbar < found.enhanced;
  const double left = volume ? found.bbar : found.enhanced;
  return fmt::format(
      "warning: section '{}': {:.2g} % of the {} is in strains that {} cells "
      "cannot avoid (they lock, {}): the body is too stiff; give it {}{}or more cells",
      found.section, 100 * (1 - left / found.energy),
      found.flows ? "work done on cells that flow" : "strain energy",
      found.second ? "plain" : "first-order",
      found.flows ? "since flow keeps the volume"
      : volume    ? "being nearly incompressible"
                  : "in bending",
      volume         ? "formulation: bbar, "
      : found.wedges ? ""
                     : "formulation: enhanced, ",
      found.second              ? ""
      : found.wedges && !volume ? "second-order cells (S6 in place of S3), "
                                : "second-order cells, ");
}

template void measure_locking(const BasicModel<2>&, const BasicState<2>&, std::vector<Locking>&);
template void measure_locking(const BasicModel<3>&, const BasicState<3>&, std::vector<Locking>&);

}  // namespace osculate::model
