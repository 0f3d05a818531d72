#include "osculate/model/mass_scaling.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/core/dense.hpp"
#include "osculate/core/pieces.hpp"
#include "osculate/model/temperatures.hpp"

namespace osculate::model {
namespace {

/// The cells of the undeformed bodies.
template <int Dim>
struct RestingCells {
  struct Cell {
    const BasicBulkSection<Dim>* section;
    mesh::CellRef ref;
    CellMemory memory;
  };
  const BasicModel<Dim>& model;
  const BasicInertia<Dim>& inertia;
  std::vector<Cell> cells;
  std::vector<double> memory;
  Eigen::VectorXd u;

  RestingCells(const BasicModel<Dim>& m, const BasicInertia<Dim>& lumped)
      : model(m), inertia(lumped), memory(memory_size(m), 0.0) {
    for_each_cell(m, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& of) {
      cells.push_back({&section, ref, of});
    });
    warm(m, Temperatures{m.initial_temperature, {}}, 0, memory);
    u.setZero(Dim * static_cast<Eigen::Index>(m.reference.size()));
  }

  [[nodiscard]] double mass(std::size_t cell) const { return inertia.cells()[cell].mass.trace(); }

  /// m^-1/2 K m^-1/2; empty: the cell is not there, or has no answer.
  [[nodiscard]] Eigen::MatrixXd scaled_stiffness(std::size_t cell,
                                                 BasicBulkBlock<Dim>& block) const {
    const Cell& at = cells[cell];
    if (at.memory.removed) return {};
    evaluate_cell(model, *at.section, at.ref, u, at.memory.of(memory), true, block);
    if (!block.ok) return {};
    const Eigen::MatrixXd& of_nodes = inertia.cells()[cell].mass;
    Eigen::VectorXd root(block.dof_count);
    for (Eigen::Index d = 0; d < root.size(); ++d) {
      const double m = of_nodes(d / Dim, d / Dim);
      if (!(m > 0)) return {};
      root[d] = 1 / std::sqrt(m);
    }
    return root.asDiagonal() * block.result.tangent * root.asDiagonal();
  }

  /// The largest eigenvalues of all cells that are above their limit; 0 elsewhere.
  template <class LimitOf>
  [[nodiscard]] std::vector<double> above(const LimitOf& limit_of, int threads) const {
    std::vector<double> out(cells.size(), 0.0);
    constexpr std::size_t piece = 256;
    core::for_pieces(cells.size(), piece, threads, [&](std::size_t begin, std::size_t end) {
      BasicBulkBlock<Dim> block;
      for (std::size_t cell = begin; cell < end; ++cell) {
        const Eigen::MatrixXd scaled = scaled_stiffness(cell, block);
        if (scaled.size() == 0 || core::eigenvalues_below(scaled, limit_of(cell))) continue;
        out[cell] = std::max(0.0, core::eigenvalues(scaled).maxCoeff());
      }
    });
    return out;
  }
};

}  // namespace

template <int Dim>
ScaledMasses scaled_masses(const BasicModel<Dim>& model, const MassScaling& wanted,
                           const BasicInertia<Dim>& lumped, const ContactShare& contact,
                           int threads) {
  ScaledMasses out;
  const bool faster = wanted.stable_step > 0;
  if (!faster && wanted.factor == 1.0) return out;
  const RestingCells<Dim> resting(model, lumped);
  const double half = 0.5 * wanted.stable_step, allowed = faster ? 1 / (half * half) : 0;
  const auto allowed_of = [&](std::size_t cell) {
    return contact.touching[cell] ? allowed - contact.springs : allowed;
  };
  std::vector<double> largest(resting.cells.size(), 0.0);
  if (faster)
    largest =
        resting.above([&](std::size_t cell) { return wanted.factor * allowed_of(cell); }, threads);
  out.factors.assign(largest.size(), 1.0);
  std::size_t cell = 0;
  for (const BasicBulkSection<Dim>& section : model.sections) {
    ScaledMasses::Section sum;
    sum.name = section.name;
    sum.cells = section.cells.size();
    for (std::size_t i = 0; i < section.cells.size(); ++i, ++cell) {
      const double mass = resting.mass(cell);
      const double of_step = faster ? largest[cell] / allowed_of(cell) : 0;
      const double factor = std::max(wanted.factor, of_step);
      out.factors[cell] = factor;
      sum.mass += mass;
      sum.added += (factor - 1) * mass;
      sum.needed += (factor - wanted.factor) * mass;
      sum.largest = std::max(sum.largest, factor);
      if (factor > 1) ++sum.scaled;
    }
    out.sections.push_back(sum);
  }
  const auto is_one = [](double factor) { return factor == 1.0; };
  if (std::all_of(out.factors.begin(), out.factors.end(), is_one)) out.factors.clear();
  return out;
}

template <int Dim>
void add_at_nodes(const BasicModel<Dim>& model, const std::vector<double>& mass,
                  ScaledMasses& masses) {
  masses.at_nodes = mass;
  std::vector<bool> told(mass.size(), false);
  for (std::size_t s = 0; s < model.sections.size(); ++s)
    for (const mesh::CellRef& ref : model.sections[s].cells)
      for (const Index n : cell_nodes(model.mesh, ref).nodes) {
        const auto node = static_cast<std::size_t>(n);
        if (told[node] || !(mass[node] > 0)) continue;
        told[node] = true;
        masses.sections[s].added += mass[node];
        masses.sections[s].needed += mass[node];
        ++masses.sections[s].nodes;
      }
}

template ScaledMasses scaled_masses(const Model&, const MassScaling&, const BasicInertia<2>&,
                                    const ContactShare&, int);
template ScaledMasses scaled_masses(const Model3&, const MassScaling&, const BasicInertia<3>&,
                                    const ContactShare&, int);
template void add_at_nodes(const Model&, const std::vector<double>&, ScaledMasses&);
template void add_at_nodes(const Model3&, const std::vector<double>&, ScaledMasses&);

}  // namespace osculate::model
