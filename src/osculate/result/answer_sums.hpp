#pragma once
// Sums for the tables of MODEL.dat; shared by the sources of this layer.
#include <map>
#include <vector>

#include "osculate/io/dat.hpp"
#include "osculate/result/answer_tables.hpp"

namespace osculate::result {

/// What acts on the cells of some facets through these: the sum of the internal forces of each cell
/// at the nodes of its facets, which is what balances the loads beyond a section. Where facets are
/// a part of a section only, the neighbours share in the forces of the nodes on its rim.
///
/// Formula    F = sum f_int, M = sum x x f_int; torque M_c . n, bending moment |M_c - (M_c . n) n|
/// Frame      places are the current ones of cells of finite strains, else the reference
/// Units      of axisymmetric models a sector of 2 degrees
/// Tested by  tests/unit/api/test_answers.cpp
template <int Dim>
[[nodiscard]] io::DatResultant resultant_through(const AnswerModel<Dim>& answers,
                                                 const model::BasicModel<Dim>& running,
                                                 const model::BasicState<Dim>& state,
                                                 const std::vector<deck::CutFacet>& facets);

/// Energy of the springs of the penalties: shares of the slaves' nodes in contact, and that of all
/// points.
struct ContactEnergies {
  std::map<Index, double> of_nodes;
  double total = 0;
};
template <int Dim>
[[nodiscard]] ContactEnergies contact_energies(const model::BasicSystem<Dim>& system,
                                               const model::BasicModel<Dim>& model);

}  // namespace osculate::result
