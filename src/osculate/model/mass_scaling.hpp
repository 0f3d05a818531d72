#pragma once
#include <string>
#include <vector>

#include "osculate/model/inertia.hpp"

namespace osculate::model {

/// What becomes of the masses in a step with central differences.
struct ScaledMasses {
  /// Of the cells of a section.
  struct Section {
    std::string name;
    double mass = 0;    ///< of the body as it is
    double added = 0;   ///< in all
    double needed = 0;  ///< the part of it that the stable step asked for, beyond `factor`
    std::size_t cells = 0, scaled = 0;
    std::size_t nodes = 0;  ///< in contact that have mass beside that of their cells
    double largest = 1;     ///< factor of a cell's mass
  };
  std::vector<double> factors;   ///< of the cells' masses, through all sections; empty: all are 1
  std::vector<double> at_nodes;  ///< mass of nodes beside that of their cells; empty: none
  std::vector<Section> sections;

  [[nodiscard]] double factor(std::size_t cell) const {
    return factors.empty() ? 1.0 : factors[cell];
  }
};

/// What springs of contacts ask for beside the cells.
struct ContactShare {
  const std::vector<bool>& touching;  ///< of the cells
  double springs = 0;                 ///< squared frequency that is left to the springs
};

/// Selective mass scaling of whole cells: of the undeformed bodies, so that steps that go on after
/// a restart, or follow each other, have the same masses.
///
/// Formula    m -> m max(f, lambda / w) , lambda the largest eigenvalue of m^-1 K of a cell by
///            itself with its lumped mass m, w = 4 / h^2, of cells that touch less the springs'
///            share; h the stable step wanted, f the factor of all masses
/// Units      mass
/// Requires   `lumped` with the masses at the nodes alone
/// Tested by  tests/unit/deck/test_mass_scaling.cpp, verification/scaled_bar
template <int Dim>
[[nodiscard]] ScaledMasses scaled_masses(const BasicModel<Dim>& model, const MassScaling& wanted,
                                         const BasicInertia<Dim>& lumped,
                                         const ContactShare& contact, int threads);

/// Adds mass at nodes, and tells the sections to which they belong of it.
template <int Dim>
void add_at_nodes(const BasicModel<Dim>& model, const std::vector<double>& mass,
                  ScaledMasses& masses);

/// Warns where the stable step has asked for more than this share of a body's mass: vibrations are
/// slower by half of it, if it is spread as their motion is.
constexpr double much_added_mass = 0.05;

}  // namespace osculate::model
